#include "monarch_flight/ros_io/conversions.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "monarch_flight/coupling/interface_values.h"
#include "monarch_flight/ros_io/flight_messages.h"
#include "monarch_flight/ros_io/step_conversions.h"
#include "ros/wire.h"

namespace monarch_flight {
namespace {

std::mt19937_64 generator(20240501);

// Any bit pattern that is a number: subnormal, huge, negative zero.
double anyNumber() {
  while (true) {
    const std::uint64_t bits = generator();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) return value;
  }
}

Eigen::Vector3d anyVector() { return {anyNumber(), anyNumber(), anyNumber()}; }
Coordinate anyCoordinate() { return {anyNumber(), anyNumber(), anyNumber()}; }

Interface anyInterface() {
  Interface out;
  out.body.x = anyVector();
  out.body.v = anyVector();
  out.body.a = anyVector();
  for (int i = 0; i < 4; ++i) out.body.q_IB.coeffs()[i] = anyNumber();
  out.body.Omega_B = anyVector();
  out.body.Omega_dot_B = anyVector();
  out.body.pitch = anyCoordinate();
  for (Side side : kSides) out.theta[side] = anyCoordinate();
  return out;
}

Loads anyLoads() { return {anyVector(), anyVector(), anyVector(), anyVector()}; }

template <class T>
void expectBitwise(const T& a, const T& b) {
  EXPECT_EQ(0, std::memcmp(&a, &b, sizeof(T)));
}

PrescribedState anyPrescribed() {
  PrescribedValues values;
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = anyNumber();
  return prescribedOf(values);
}

void expectBitwise(const PrescribedState& a, const PrescribedState& b) {
  const PrescribedValues x = prescribedValues(a), y = prescribedValues(b);
  for (Eigen::Index i = 0; i < x.size(); ++i) expectBitwise(x[i], y[i]);
}

TEST(Conversions, RequestsCrossTheWireBitForBit) {
  for (int i = 0; i < 100; ++i) {
    Request request;
    request.key = {generator(), static_cast<std::uint32_t>(generator()),
                   static_cast<std::uint32_t>(generator()), static_cast<Phase>(i % 4)};
    request.t = anyNumber();
    request.prescribed = anyPrescribed();
    request.interface = anyInterface();
    for (Side side : kSides) request.loads[side] = anyLoads();
    request.block_points = static_cast<std::uint32_t>(i);
    request.want_surface = i % 2 == 1;
    request.want_operator = i % 3 == 1;
    const Request back = fromMessage(overTheWire(toMessage(request)));
    EXPECT_EQ(request.key, back.key);
    expectBitwise(request.t, back.t);
    expectBitwise(request.prescribed, back.prescribed);
    expectBitwise(request.interface, back.interface);
    EXPECT_EQ(request.block_points, back.block_points);
    expectBitwise(request.loads, back.loads);
    EXPECT_EQ(request.want_surface, back.want_surface);
    EXPECT_EQ(request.want_flow, back.want_flow);
    EXPECT_EQ(request.want_operator, back.want_operator);
  }
}

TEST(Conversions, RepliesCrossTheWireBitForBit) {
  for (int i = 0; i < 100; ++i) {
    Reply reply;
    reply.key = {generator(), 7, 3, Phase::kCommit};
    reply.interface = anyInterface();
    reply.loads = anyLoads();
    reply.report.courant = anyNumber();
    reply.report.divergence = anyNumber();
    reply.report.cells = i;
    if (i % 2 == 1) {
      for (int k = 0; k < 36; ++k) reply.report.added_mass(k / 6, k % 6) = anyNumber();
    }
    reply.report.operator_cost = i % 7;
    for (double& s : reply.report.kernel_s) s = anyNumber();
    if (i % 3 == 1) {
      reply.jacobian.emplace();
      for (int k = 0; k < 36; ++k) {
        reply.jacobian->velocity(k / 6, k % 6) = anyNumber();
        reply.jacobian->acceleration(k / 6, k % 6) = anyNumber();
      }
    }
    if (i % 2 == 0) reply.prescribed = anyPrescribed();
    if (i % 3 == 2) {
      reply.command.emplace();
      for (const CommandInfo& info : kCommandTable) (*reply.command).*info.value = anyNumber();
    }
    reply.guidance.lost = i % 5 == 0;
    reply.wall_s = anyNumber();
    reply.error = i % 3 == 0 ? "why" : "";
    reply.surface.facets.push_back({1.5f, -2.5f, 3e-38f, 4.0f, -0.0f, 6e30f});
    if (i % 2 == 1)
      reply.picture = {{1.0f, -2.0f, 3e-38f}, 0.5f, {1, 2, 1}, 0.25f, {7, -7}, {32767, -32768}};
    const Reply back = fromMessage(overTheWire(toMessage(reply)));
    EXPECT_EQ(reply.key, back.key);
    ASSERT_EQ(reply.prescribed.has_value(), back.prescribed.has_value());
    if (reply.prescribed) expectBitwise(*reply.prescribed, *back.prescribed);
    ASSERT_EQ(reply.command.has_value(), back.command.has_value());
    for (const CommandInfo& info : kCommandTable)
      if (reply.command) expectBitwise((*reply.command).*info.value, (*back.command).*info.value);
    EXPECT_EQ(reply.guidance.lost, back.guidance.lost);
    expectBitwise(reply.interface, back.interface);
    expectBitwise(reply.loads, back.loads);
    expectBitwise(reply.report.courant, back.report.courant);
    expectBitwise(reply.report.divergence, back.report.divergence);
    EXPECT_EQ(reply.report.cells, back.report.cells);
    expectBitwise(reply.report.added_mass, back.report.added_mass);
    EXPECT_EQ(reply.report.operator_cost, back.report.operator_cost);
    for (std::size_t k = 0; k < kKernels; ++k) {
      expectBitwise(reply.report.kernel_s[k], back.report.kernel_s[k]);
    }
    ASSERT_EQ(reply.jacobian.has_value(), back.jacobian.has_value());
    if (reply.jacobian) {
      expectBitwise(reply.jacobian->velocity, back.jacobian->velocity);
      expectBitwise(reply.jacobian->acceleration, back.jacobian->acceleration);
    }
    expectBitwise(reply.wall_s, back.wall_s);
    EXPECT_EQ(reply.error, back.error);
    ASSERT_EQ(1u, back.surface.facets.size());
    expectBitwise(reply.surface.facets[0], back.surface.facets[0]);
    EXPECT_EQ(reply.picture.origin, back.picture.origin);
    EXPECT_EQ(reply.picture.spacing, back.picture.spacing);
    EXPECT_EQ(reply.picture.size, back.picture.size);
    EXPECT_EQ(reply.picture.step, back.picture.step);
    EXPECT_EQ(reply.picture.q_root, back.picture.q_root);
    EXPECT_EQ(reply.picture.omega_y, back.picture.omega_y);
  }
}

TEST(Conversions, IterationRecordsCrossBitForBit) {
  IterationRecord record;
  record.step = 4000000000u;
  record.iteration = 17;
  record.attempt = 2;
  for (double& r : record.residual) r = anyNumber();
  record.load_residual = anyNumber();
  record.relaxation = anyNumber();
  record.fluid_wall_s = anyNumber();
  const IterationRecord back = fromMessage(overTheWire(toMessage(record)));
  EXPECT_EQ(record.step, back.step);
  EXPECT_EQ(record.iteration, back.iteration);
  EXPECT_EQ(record.attempt, back.attempt);
  expectBitwise(record.residual, back.residual);
  expectBitwise(record.load_residual, back.load_residual);
  expectBitwise(record.relaxation, back.relaxation);
  expectBitwise(record.fluid_wall_s, back.fluid_wall_s);
}

TEST(Conversions, NamedFieldsAreThoseOfTheTables) {
  IterationRecord record;
  for (std::size_t i = 0; i < kCoordinates; ++i) record.residual[i] = static_cast<double>(i + 1);
  const CoordinateResiduals residual = toMessage(record).residual;
  EXPECT_EQ(record.residual[kX], residual.x);
  EXPECT_EQ(record.residual[kY], residual.y);
  EXPECT_EQ(record.residual[kZ], residual.z);
  EXPECT_EQ(record.residual[kRoll], residual.roll);
  EXPECT_EQ(record.residual[kPitch], residual.pitch);
  EXPECT_EQ(record.residual[kYaw], residual.yaw);
  EXPECT_EQ(record.residual[kThetaR], residual.theta_right);
  EXPECT_EQ(record.residual[kThetaL], residual.theta_left);

  std::array<double, kRoles> wall_s{};
  const auto of = [&wall_s](Role role) -> double& { return wall_s[std::size_t(role)]; };
  for (Role role : kAllRoles) of(role) = 1.0 + static_cast<double>(role);
  const RoleTimes roles = toMessage(wall_s);
  EXPECT_EQ(of(Role::kFluid), roles.fluid);
  EXPECT_EQ(of(Role::kFlight), roles.flight);
  EXPECT_EQ(of(Role::kWing), roles.wing);
  EXPECT_EQ(of(Role::kGuidance), roles.guidance);
  EXPECT_EQ(of(Role::kFluidLeft), roles.fluid_left);

  KernelTimes times{};
  for (std::size_t i = 0; i < kKernels; ++i) times[i] = static_cast<double>(i + 1);
  const FluidKernelTimes kernels = toMessage(times);
  const double in_order[] = {kernels.turning,     kernels.momentum_x_y, kernels.momentum_z,
                             kernels.net_outflow, kernels.transforms,   kernels.columns,
                             kernels.capacitance, kernels.loads,        kernels.projection};
  for (std::size_t i = 0; i < kKernels; ++i) EXPECT_EQ(times[i], in_order[i]) << kKernelNames[i];
}

TEST(Conversions, AWrenchOfAMatrixIsAColumn) {
  Reply reply;
  reply.report.added_mass(3, 1) = 7.0;  // moment about x by an acceleration along y
  reply.jacobian.emplace();
  reply.jacobian->velocity(2, 4) = 5.0;  // force along z by a rate about y
  reply.jacobian->acceleration(5, 0) = 3.0;
  const ParticipantReply message = toMessage(reply);
  ASSERT_EQ(6u, message.added_mass.size());
  EXPECT_EQ(7.0, message.added_mass[1].torque.x);
  ASSERT_EQ(1u, message.load_operator.size());
  EXPECT_EQ(5.0, message.load_operator[0].velocity[4].force.z);
  EXPECT_EQ(3.0, message.load_operator[0].acceleration[0].torque.z);
}

TEST(Conversions, UnusableMessagesAreNamed) {
  ParticipantRequest request = toMessage(Request());
  EXPECT_EQ("", problem(request));
  request.key.phase = 6;
  EXPECT_EQ("unknown phase 6", problem(request));
  request.protocol = kProtocolVersion + 1;
  EXPECT_NE(std::string::npos,
            problem(request).find("protocol version " + std::to_string(kProtocolVersion + 1) +
                                  " instead of"));
  ParticipantReply reply = toMessage(Reply());
  EXPECT_EQ("", problem(reply));
  reply.added_mass.resize(5);
  EXPECT_EQ("added mass of 5 columns, not 6", problem(reply));
  reply.added_mass.clear();
  reply.load_operator.resize(2);
  EXPECT_EQ("2 load operators, at most one fits", problem(reply));
  reply.load_operator.clear();
  reply.kernel_times.resize(3);
  EXPECT_EQ("3 times by kernel, at most one fits", problem(reply));
  reply.kernel_times.clear();
  reply.block.resize(1);
  reply.block[0].size = {2, 2, 2};
  reply.block[0].q_root.resize(8);
  reply.block[0].vorticity.resize(7);
  EXPECT_EQ("a block of the flow whose fields do not fit its size", problem(reply));
  reply.block[0].vorticity.resize(8);
  EXPECT_EQ("a block of the flow that is not finite", problem(reply));  // no spacing
  reply.block[0].spacing = 0.1f;
  EXPECT_EQ("", problem(reply));
  reply.block[0].size = {4000000000u, 4000000000u, 4000000000u};
  EXPECT_EQ("a block of the flow whose fields do not fit its size", problem(reply));
}

TEST(Conversions, NonFiniteStatesAreSeenInEveryMember) {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  for (double value : bad) {
    for (int member = 0; member < 9; ++member) {
      Interface interface;
      EXPECT_TRUE(finite(interface));
      Eigen::Vector3d* vectors[] = {&interface.body.x, &interface.body.v, &interface.body.a,
                                    &interface.body.Omega_B, &interface.body.Omega_dot_B};
      if (member < 5) {
        (*vectors[member])[2] = value;
      } else if (member == 5) {
        interface.body.q_IB.z() = value;
      } else {
        Coordinate* coordinates[] = {&interface.body.pitch, &interface.theta.right,
                                     &interface.theta.left};
        coordinates[member - 6]->qdd = value;
      }
      EXPECT_FALSE(finite(interface)) << member;
    }
  }
}

}  // namespace
}  // namespace monarch_flight
