// The flight controller by itself: when it samples, what it commands, what it remembers, when it
// gives up.
#include <cmath>
#include <limits>

#include "guidance_fixture.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

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

}  // namespace
}  // namespace monarch_flight
