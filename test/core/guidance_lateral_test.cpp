// The lateral law by itself: its reference, what it feeds back, what it remembers, what is refused.
#include <cmath>

#include "guidance_fixture.h"
#include "monarch_flight/insect/start_motion.h"

namespace monarch_flight {
namespace {

/// A lateral law of one input that only refers, of wings that differ.
LateralSettings aside(int N) {
  LateralSettings s;
  s.gains.inputs = {kDifferentialDeviation};
  s.gains.state = Eigen::MatrixXd::Zero(N, 5);
  s.gains.filter = Eigen::MatrixXd::Zero(N, 3);
  s.gains.integral = Eigen::MatrixXd::Zero(N, 2);
  s.turn = 0.1;
  s.turn_commands = Eigen::VectorXd::Constant(1, 0.5);
  s.turn_states = Eigen::MatrixXd::Zero(N, 5);
  s.commands = Eigen::VectorXd::Constant(1, 0.03);
  s.states = Eigen::MatrixXd::Zero(N, 5);
  return s;
}

/// A body with this heading and roll, upright else.
void setAngles(BodyState& body, double roll, double yaw) {
  body = withAngles(body, {roll, 0.0, 0.0}, body.pitch, {yaw, 0.0, 0.0});
}

TEST(LateralControl, ReferenceTurnsToTheHeadingWithinItsRateAndStops) {
  ControllerSettings s = simple();
  s.lateral = aside(4);
  s.set_points.front().heading = 0.2;
  s.set_points.push_back({3.0, 1.0, 0.0, 1.5});
  s.first_step = 4;  // prescribed
  Ride ride(s);
  setAngles(ride.input.interface.body, 0.0, 0.2);
  double before = 0.2, largest = 0.0;
  for (int k = 0; k < 160; ++k) {
    const auto u = ride.ask(0.25 * k);
    const LateralControl& lateral = *ride.controller.lateral();
    EXPECT_NEAR(u->differential_deviation, 0.03 + 0.5 * lateral.turnRate(), 1e-15);
    EXPECT_GE(lateral.reference(), before - 1e-12);
    EXPECT_LE(lateral.reference() - before, 0.25 * 0.1 + 1e-12);
    largest = std::max(largest, lateral.turnRate());
    before = lateral.reference();
    EXPECT_TRUE(0.25 * k >= 3.0 || std::abs(lateral.reference() - 0.2) < 1e-12) << k;
  }
  EXPECT_NEAR(largest, 0.1, 1e-12);
  EXPECT_NEAR(before, 1.5, 1e-9);
  EXPECT_NEAR(ride.controller.lateral()->turnRate(), 0.0, 1e-9);
}

TEST(LateralControl, FeedsBackSideVelocityRollAndHeadingOverWholeTurns) {
  ControllerSettings s = simple();
  s.lateral = aside(4);
  s.lateral->gains.state.setZero();
  for (int j = 0; j < 4; ++j) s.lateral->gains.state.row(j) << 2.0, 3.0, 0.0, 5.0, 0.0;
  s.lateral->gains.filter.col(0).setConstant(7.0);
  Ride ride(s);
  ride.applied[kDifferentialDeviation] = {0.01, 0.0, 0.0};
  for (int k = 0; k <= 16; ++k) {  // 2.4 rad a flap
    const double yaw = 0.6 * k, roll = 0.01 * k;
    BodyState& body = ride.input.interface.body;
    setAngles(body, roll, yaw);
    body.v = {std::cos(yaw) - 0.2 * std::sin(yaw), std::sin(yaw) + 0.2 * std::cos(yaw), 0.0};
    const auto u = ride.ask(0.25 * k);
    if (ride.controller.lost()) FAIL() << k;
    EXPECT_NEAR(u->differential_deviation,
                0.03 - 2.0 * 0.2 - 3.0 * roll - 5.0 * yaw - 7.0 * (0.01 - 0.03), 1e-12)
        << k;
  }
  setAngles(ride.input.interface.body, 1.1, 0.0);  // lost_pitch is 1
  ride.ask(4.3);
  EXPECT_TRUE(ride.controller.lost());
}

TEST(LateralControl, MemoryIsBitExact) {
  ControllerSettings s = simple(3);
  s.lateral = aside(3);
  s.lateral->gains.state.setConstant(0.013);
  s.lateral->gains.filter.setConstant(0.017);
  s.lateral->gains.integral.setConstant(0.019);
  s.lateral->turn_states.setConstant(0.023);
  s.lateral->states.setConstant(0.029);
  s.set_points = {{0.0, 1.0, 0.0}, {1.0, 1.0, 0.0, 4.0}};
  Ride first(s), second(s);
  first.limit = second.limit = 0.08;
  const auto ask = [](Ride& ride, int k) {
    BodyState& body = ride.input.interface.body;
    setAngles(body, 0.2 * std::sin(k), 0.3 * k + 0.1 * std::cos(k));
    body.v = {1.0, 0.3 * std::sin(0.7 * k), 0.0};
    ride.applied[kDifferentialDeviation] = {0.01 * std::cos(k), 0.02, 0.03};
    return ride.ask(0.07 * k);
  };
  for (int k = 0; k < 41; ++k) ask(first, k);  // in the middle of a sample and of a turn
  ASSERT_GT(first.controller.lateral()->turnRate(), 0.0);
  StateSnapshot memory;
  memory.take([&](StateVisitor& state) { first.controller.memory(state); });
  memory.putBack([&](StateVisitor& state) { second.controller.memory(state); });
  second.taken = first.taken;
  int asked = 0;
  for (int k = 41; k < 90; ++k) {
    const auto a = ask(first, k), b = ask(second, k);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++asked;
    for (const CommandInfo& info : kCommandTable) EXPECT_EQ((*a).*info.value, (*b).*info.value);
  }
  EXPECT_GT(asked, 5);
}

TEST(ControllerSettings, EveryFaultOfTheLateralLawIsNamed) {
  ControllerSettings s = simple();
  s.lateral = aside(4);
  EXPECT_TRUE(s.problems().empty());
  s.lateral->gains.inputs = {kDeviation};
  s.lateral->gains.state.resize(3, 5);
  s.lateral->turn_states(1, 2) = std::nan("");
  s.lateral->commands.resize(2);
  s.lateral->turn = 0.0;
  s.set_points.front().heading = std::nan("");
  std::string all;
  for (const std::string& fault : s.problems()) all += fault + "\n";
  for (const char* part :
       {"lateral/inputs", "lateral/gains/state", "lateral/turn/states", "lateral/straight/commands",
        "lateral/turn/most_deg = 0", "set_points[0] heading"})
    EXPECT_NE(all.find(std::string("guidance/controller/") + part), std::string::npos) << part;
}

}  // namespace
}  // namespace monarch_flight
