// The flight controller by itself: when it samples, what it commands, what it remembers, when it
// gives up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "monarch_flight/guidance/flight_controller.h"
#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr std::size_t kAmplitude = 0, kDeviation = 3;

/// Two inputs, N samples, a table of one point: 1 m/s, level, no orbit but theta_B = 0.1 j.
ControllerSettings simple(int N = 4) {
  ControllerSettings s;
  s.samples = N;
  s.gains.inputs = {kAmplitude, kDeviation};
  s.time_constant = 0.1;
  s.wing_pitch = false;
  Eigen::MatrixXd commands(1, 2), states(N, 4);
  commands << 0.01, 0.02;
  for (int j = 0; j < N; ++j) states.row(j) << 1.0, 0.0, 0.1 * j, 0.0;
  s.table = {{1.0}, {0.0}, commands, states};
  s.gains.state = Eigen::MatrixXd::Zero(2 * N, 4);
  s.gains.filter = Eigen::MatrixXd::Zero(2 * N, 6);
  s.gains.integral = Eigen::MatrixXd::Zero(2 * N, 2);
  s.set_points = {{0.0, 1.0, 0.0}};
  s.slew = 0.1;
  s.lost_pitch = 1.0;
  s.lost_flaps = 3.0;
  return s;
}

/// Asks a controller level by level; commands are taken within +-limit.
struct Ride {
  explicit Ride(const ControllerSettings& settings) : controller(settings) {
    input.dt = 0.01;
    input.interface.body.v.x() = 1.0;
  }
  std::optional<WingbeatChange> ask(double phase) {
    ++input.step;
    const auto wanted = controller.next({input, phase, 10.0, input.dt, taken, applied});
    if (wanted) {
      taken = *wanted;
      for (const CommandInfo& info : kCommandTable)
        taken.*info.value = std::clamp(taken.*info.value, -limit, limit);
    }
    return wanted;
  }
  FlightController controller;
  GuidanceInput input;
  WingbeatChange taken;
  std::array<Coordinate, kCommands> applied{};
  double limit = 1e9;
};

TEST(FlightController, SamplesOnThePhaseAndNotInBetween) {
  Ride ride(simple());
  const double phases[] = {0.0, 0.1, 0.2499999999, 0.26, 0.3, 0.49, 0.51, 0.76, 0.99, 1.0, 1.2};
  const bool sampled[] = {true, false, true, false, false, false, true, true, false, true, false};
  for (std::size_t i = 0; i < std::size(phases); ++i)
    EXPECT_EQ(ride.ask(phases[i]).has_value(), sampled[i]) << phases[i];
}

TEST(FlightController, CommandsTheLaw) {
  ControllerSettings s = simple();
  for (int j = 0; j < 4; ++j) {
    s.gains.state.row(2 * j) << 0.3, 0.5, 0.7 + j, 0.11;
    s.gains.filter.row(2 * j + 1) << 0.0, 0.0, 0.0, 2.0, 3.0, 5.0;
  }
  Ride ride(s);
  ride.input.interface.body.v = {1.2, 0.0, 0.4};
  ride.input.prescribed.wind.v = {0.05, 0.0, 0.1};
  ride.input.interface.body.pitch = {0.25, -0.3, 0.0};
  ride.applied[kDeviation] = {0.05, 0.006, 0.0007};
  ride.ask(0.0);
  // The second sample; the table has one point, 1 m/s and level. The integrals have no gain.
  const WingbeatChange u = *ride.ask(0.25);
  EXPECT_NEAR(u.amplitude,
              0.01 - (0.3 * (1.15 - 1.0) + 0.5 * 0.3 + 1.7 * (0.25 - 0.1) + 0.11 * -0.3), 1e-14);
  EXPECT_NEAR(u.deviation_mean, 0.02 - (2.0 * (0.05 - 0.02) + 3.0 * 0.006 + 5.0 * 0.0007), 1e-14);
  EXPECT_EQ(u.frequency, 0.0);
}

TEST(FlightController, FirstStepsArePrescribed) {
  ControllerSettings s = simple();
  s.gains.state.setOnes();
  s.first_step = 3;
  Ride ride(s);
  ride.input.interface.body.pitch.q = 0.5;
  for (int step = 0; step < 3; ++step) {
    const auto u = ride.ask(0.25 * step);
    ASSERT_TRUE(u);
    EXPECT_EQ(u->amplitude, 0.01);
    EXPECT_EQ(u->deviation_mean, 0.02);
  }
  EXPECT_EQ(ride.controller.integral().norm(), 0.0);
  EXPECT_NE(ride.ask(0.75)->amplitude, 0.01);
}

TEST(FlightController, IntegratesTheMeanOfTheFlap) {
  ControllerSettings s = simple(1);  // one sample a flap
  s.gains.integral << 0.5, 0.0, 0.0, 0.25;
  Ride ride(s);
  constexpr int kLevels = 100;
  for (int flap = 0; flap < 3; ++flap)
    for (int k = 0; k < kLevels; ++k) {
      const double phase = flap + static_cast<double>(k) / kLevels;
      ride.input.interface.body.v.x() = 1.0 + 0.02 + 0.3 * std::sin(2 * M_PI * phase);
      ride.input.interface.body.v.z() = -0.01 + 0.2 * std::cos(2 * M_PI * phase);
      ride.ask(phase);
    }
  ride.input.interface.body.v = {1.02, 0.0, 0.19};
  const WingbeatChange u = *ride.ask(3.0);
  EXPECT_NEAR(ride.controller.integral().x(), 3 * 0.02, 1e-12);
  EXPECT_NEAR(ride.controller.integral().y(), 3 * -0.01, 1e-12);
  EXPECT_NEAR(u.amplitude, 0.01 - 0.5 * 0.06, 1e-12);
  EXPECT_NEAR(u.deviation_mean, 0.02 + 0.25 * 0.03, 1e-12);
}

TEST(FlightController, IntegralStopsWhereAnInputIsLimited) {
  ControllerSettings s = simple();
  for (int j = 0; j < 4; ++j) s.gains.integral(2 * j, 0) = 1.0;
  Ride ride(s);
  ride.limit = 0.1;
  ride.input.interface.body.v.x() = 0.0;  // too slow by 1 m/s: the amplitude is driven up
  for (int k = 0; k < 8; ++k) ride.ask(0.25 * k);
  const double stopped = ride.controller.integral().x();
  EXPECT_NEAR(stopped, -0.25, 1e-12);  // the first step led over the limit
  ride.input.interface.body.v.x() = 2.0;
  ride.ask(2.0);  // the mean since the last sample is 1 m/s: neither way
  ride.ask(2.25);
  EXPECT_GT(ride.controller.integral().x(), stopped);  // it comes back at once
  EXPECT_FALSE(ride.controller.lost());
}

TEST(FlightController, LostWhenThePitchIsTooFarOff) {
  ControllerSettings s = simple();
  s.gains.state.setOnes();
  Ride ride(s);
  ride.ask(0.0);
  ride.input.interface.body.pitch.q = 1.05;  // 0.95 off
  ride.ask(0.25);
  EXPECT_FALSE(ride.controller.lost());
  ride.input.interface.body.pitch.q = 1.25;  // 1.05 off
  const auto u = ride.ask(0.5);
  EXPECT_TRUE(ride.controller.lost());
  EXPECT_EQ(u->amplitude, 0.01);
  ride.input.interface.body.pitch.q = 0.3;  // for good
  EXPECT_EQ(ride.ask(0.75)->deviation_mean, 0.02);
  EXPECT_TRUE(ride.controller.lost());
  ride.controller.start();
  EXPECT_FALSE(ride.controller.lost());
}

TEST(FlightController, LostWhenNotFinite) {
  ControllerSettings s = simple();
  s.gains.state.setOnes();
  Ride ride(s);
  ride.ask(0.0);
  ride.input.interface.body.pitch.qd = std::numeric_limits<double>::quiet_NaN();
  const auto u = ride.ask(0.25);
  EXPECT_TRUE(ride.controller.lost());
  EXPECT_EQ(u->amplitude, 0.01);
}

TEST(FlightController, LostWhenLimitedForTooLong) {
  ControllerSettings s = simple();
  for (int j = 0; j < 4; ++j) s.gains.state(2 * j, 0) = 1.0;
  Ride ride(s);
  ride.limit = 0.1;
  ride.input.interface.body.v.x() = 0.0;
  double phase = 0.0;
  for (; !ride.controller.lost() && phase < 10.0; phase += 0.25) ride.ask(phase);
  EXPECT_GT(phase, 3.0);  // lost_flaps
  EXPECT_LT(phase, 4.0);
}

TEST(FlightController, SetPointMovesAtTheSlewAndLessTheWind) {
  ControllerSettings s = simple();
  s.set_points = {{0.0, 1.0, 0.0}, {1.0, 1.3, 0.0}};
  Ride ride(s);
  for (int k = 0; k <= 3; ++k) ride.ask(0.25 * k);
  EXPECT_NEAR(ride.controller.reference().x(), 1.0, 1e-15);
  for (int k = 4; k <= 8; ++k) ride.ask(0.25 * k);
  EXPECT_NEAR(ride.controller.reference().x(), 1.0 + 1.25 * 0.1, 1e-12);
  for (int k = 9; k <= 30; ++k) ride.ask(0.25 * k);
  EXPECT_NEAR(ride.controller.reference().x(), 1.3, 1e-12);
  ride.input.prescribed.wind.v.x() = 0.2;
  for (int k = 31; k <= 150; ++k) ride.ask(0.25 * k);
  EXPECT_NEAR(ride.controller.reference().x(), 1.1, 1e-9);
}

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

TEST(FlightController, MemoryIsBitExact) {
  ControllerSettings s = simple(3);
  s.gains.state.setConstant(0.013);
  s.gains.filter.setConstant(0.017);
  s.gains.integral.setConstant(0.019);
  s.set_points = {{0.0, 1.0, 0.0}, {2.0, 1.4, 0.2}};
  Ride first(s), second(s);
  first.limit = second.limit = 0.05;
  const auto ask = [](Ride& ride, int k) {
    ride.input.interface.body.v = {1.0 + 0.3 * std::sin(k), 0.0, 0.2 * std::cos(1.7 * k)};
    ride.input.prescribed.wind.v.x() = 0.1 * std::sin(0.3 * k);
    ride.input.interface.body.pitch = {0.1 * std::sin(0.9 * k), std::cos(k), 0.0};
    ride.applied[kAmplitude] = {0.01 * std::cos(k), 0.02, 0.03};
    return ride.ask(0.07 * k);
  };
  for (int k = 0; k < 40; ++k) ask(first, k);
  StateSnapshot memory;
  memory.take([&](StateVisitor& state) { first.controller.memory(state); });
  memory.putBack([&](StateVisitor& state) { second.controller.memory(state); });
  second.taken = first.taken;
  for (int k = 40; k < 90; ++k) {
    const auto a = ask(first, k), b = ask(second, k);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    for (const CommandInfo& info : kCommandTable) EXPECT_EQ((*a).*info.value, (*b).*info.value);
  }
}

TEST(TrimTable, IsBilinearAndEndsAtItsEdges) {
  Eigen::MatrixXd commands(4, 1), states(4, 4);
  commands << 1.0, 2.0, 3.0, 5.0;  // speeds 1, 2; climbs 0, 0.2
  const double climbs[] = {0.0, 0.2, 0.0, 0.2}, speeds[] = {1.0, 1.0, 2.0, 2.0};
  for (int i = 0; i < 4; ++i)
    states.row(i) << speeds[i] * std::cos(climbs[i]) + 0.3, -speeds[i] * std::sin(climbs[i]),
        commands(i), 0.0;
  const TrimTable table({1.0, 2.0}, {0.0, 0.2}, commands, states);
  TrimReference r;
  r.commands.setZero(1);
  r.state.setZero(4);
  r.next.setZero(4);
  table.at(SetPoint{0, 1.5, 0.1}.velocity(), 0, r);
  EXPECT_NEAR(r.commands(0), 2.75, 1e-12);
  EXPECT_NEAR(r.state(2), 2.75, 1e-12);
  // The orbit's mean is moved to the velocity asked for; that of one sample is no mean.
  EXPECT_NEAR(r.state(0), 1.5 * std::cos(0.1) + 0.3, 1e-12);
  EXPECT_NEAR(r.velocity.x(), 1.5 * std::cos(0.1), 1e-12);
  table.at(SetPoint{0, 9.0, -1.0}.velocity(), 0, r);
  EXPECT_NEAR(r.commands(0), 3.0, 1e-12);
  EXPECT_NEAR(r.velocity.x(), 2.0, 1e-12);
}

TEST(ControllerSettings, EveryFaultIsNamed) {
  ControllerSettings s = simple();
  EXPECT_TRUE(s.problems().empty());
  s.gains.inputs = {kAmplitude, kAmplitude};
  s.gains.state.resize(3, 4);
  s.gains.filter(0, 0) = std::nan("");
  s.set_points = {{0.0, -1.0, 0.0}, {0.0, 1.0, 2.0}};
  s.slew = 0.0;
  s.lost_pitch = -1.0;
  std::string all;
  for (const std::string& fault : s.problems()) all += fault + "\n";
  for (const char* part :
       {"inputs", "gains/state", "gains/filter", "set_points[0] speed", "set_points[1] climb",
        "set_points[1] flap", "slew = 0", "lost/pitch_deg"})
    EXPECT_NE(all.find(std::string("guidance/controller/") + part), std::string::npos) << part;
  EXPECT_THROW(FlightController{s}, InputError);
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
