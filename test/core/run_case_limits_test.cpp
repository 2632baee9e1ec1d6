// Cases that ask for what the model, or its time step, cannot give: named, with the way out.
#include <gtest/gtest.h>

#include <tuple>

#include "core/case_fixture.h"
#include "monarch_flight/run/remarks.h"

namespace monarch_flight {
namespace {

constexpr char kMirrored[] = "must be 0 while only one wing is solved and mirrored";

/// A monarch in quasi-steady air; `motion` and `more` are sections of the case.
std::string monarch(const std::string& motion, const std::string& more = "") {
  return "name: limits\ninsect: {preset: monarch_paper}\nfluid: {solver: quasi_steady}\n" + motion +
         "free: {x: true, z: true, pitch: true, wing_pitch: true}\n" +
         "time: {steps_per_flap: 500, flaps: 1}\n" + more;
}

std::string fourier(const std::string& velocity) {
  return "motion: {type: fourier, series: monarch, frequency: 10.2, body: {position: [0, 2, 0], "
         "velocity: " +
         velocity + "}}\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(CaseTest, AMirroredInsectHasNoAirFromTheSide) {
  const std::string straight = monarch(fourier("[1.3, 0, -0.562]"));
  EXPECT_EQ(faults(write("straight.yaml", straight)), "");  // y = 2 m: the air is the same there
  for (const std::string y : {"1", "-1", "1e-3"}) {
    const std::string windy =
        replaced(straight, "quasi_steady", "quasi_steady, wind: [0.5, " + y + ", 0]");
    std::string text = faults(write("wind.yaml", windy));
    expectHas(text, "fluid/wind[1] = " + std::string(y == "1e-3" ? "0.001" : y) + " m/s: ");
    expectHas(text, kMirrored);
    text = faults(write("moving.yaml", monarch(fourier("[1.3, " + y + ", -0.562]"))));
    expectHas(text, "motion/body/velocity[1] = ");
    expectHas(text, kMirrored);
  }
  const std::string starting = straight + "initial: {velocity: [1.3, 0.2, -0.562]}\n";
  expectHas(faults(write("initial.yaml", starting)), "initial/velocity[1] = 0.2 m/s: must be 0");
  const std::string all =
      replaced(monarch(fourier("[1, 2, 3]"), "initial: {velocity: [1, 2, 3]}\n"), "quasi_steady",
               "quasi_steady, wind: [0, 1, 0]");
  const std::string text = faults(write("all.yaml", all));
  expectHas(text, "3 faults");
}

TEST_F(CaseTest, ATableOfAMirroredInsectStaysInItsPlane) {
  const std::string table = replaced(
      replaced(monarch("motion: {type: table, kind: body, frequency: 10.2, file: m.csv}\n"),
               "x: true, z: true, pitch: true, wing_pitch: true",
               "x: false, z: false, pitch: false, wing_pitch: false"),
      "flaps: 1", "flaps: 0.5");
  const auto rows = [&](double rate) {
    std::ostringstream text;
    text << "t,x,y,z,theta_B,phi,psi,theta_R,theta_A\n";
    for (int i = 0; i <= 20; ++i) text << 0.005 * i << ",0," << 1 + rate * i << ",0,0.3,0,0,0,0\n";
    return write("m.csv", text.str());
  };
  const std::string path = write("table.yaml", table);
  rows(0.0);
  EXPECT_EQ(faults(path), "");
  rows(1e-4);
  expectHas(faults(path), "m.csv: row 2, column y = 1.0001 m: must stay 1 m while only one wing");
}

TEST_F(CaseTest, ABareWingMayMeetItsAirFromTheSide) {
  std::string plate(kPlate);
  plate = replaced(plate, "gravity: 0", "gravity: 0, wind: [0, 0.5, 0]");
  plate +=
      "motion: {type: fourier, frequency: 0, phi_deg: 0, psi_deg: 0, theta_R_deg: 0, "
      "theta_B_deg: 0, body: {position: [0, 0, 0], velocity: [1, 0.3, 0]}}\n";
  EXPECT_EQ(faults(write("plate.yaml", plate)), "");
}

TEST_F(CaseTest, ARunHasWholeStepsAndSaysWhatIsLeft) {
  const auto timed = [&](const std::string& dt, const std::string& duration) {
    std::string plate =
        replaced(kPlate, "dt: 0.02, duration: 1", "dt: " + dt + ", duration: " + duration);
    plate +=
        "motion: {type: fourier, frequency: 0, phi_deg: 0, psi_deg: 0, theta_R_deg: 0, "
        "theta_B_deg: 0, body: {position: [0, 0, 0], velocity: [1, 0, 0]}}\n";
    return loadCase(write("timed.yaml", plate), {}, CONFIG_DIR);
  };
  Case c = timed("0.0003", "0.001");
  EXPECT_EQ(c.time.steps, 3u);
  EXPECT_NEAR(c.time.remainder, 1.0 / 3.0, 1e-9);
  ASSERT_EQ(runRemarks(c, 3).size(), 1u);
  expectHas(runRemarks(c, 3)[0],
            "ends with its last whole step, 3, after 0.0009 s; the remainder of 0.333333 steps");
  EXPECT_TRUE(runRemarks(c, 2).empty());  // it has not come so far
  for (const auto& [dt, duration, steps] :
       {std::tuple{"0.02", "0.3", 15u}, std::tuple{"0.1", "0.3", 3u},
        std::tuple{"0.0001", "0.7", 7000u}, std::tuple{"0.033333", "0.1", 3u},
        std::tuple{"0.033333333", "0.1", 3u}}) {
    c = timed(dt, duration);
    EXPECT_EQ(c.time.steps, steps) << dt;
    EXPECT_EQ(c.time.remainder, 0.0) << dt;
    EXPECT_TRUE(runRemarks(c, steps).empty());
  }
  expectHas(faultsWith("plate_re100", "duration: 10", "duration: 0.01"),
            "time/duration amounts to 0.5 steps: must be 1 to");
}

TEST_F(CaseTest, FlapsAreCountedInWholeSteps) {
  for (const auto& [flaps, steps, left] :
       {std::tuple{"0.05", 25u, 0.0}, std::tuple{"0.1", 50u, 0.0}, std::tuple{"1e-1", 50u, 0.0},
        std::tuple{"0.002", 1u, 0.0}, std::tuple{"1.998", 999u, 0.0},
        std::tuple{"0.333", 166u, 0.5}, std::tuple{"0.3333332", 166u, 2.0 / 3.0}}) {
    const Case c =
        loadCase("climb_printed", {{"flaps", flaps}, {"fluid", "quasi_steady"}}, CONFIG_DIR);
    EXPECT_EQ(c.time.steps, steps) << flaps;
    EXPECT_NEAR(c.time.remainder, left, 1e-4) << flaps;
    std::string remarks;
    for (const std::string& remark : runRemarks(c, steps)) remarks += remark;
    EXPECT_EQ(remarks.find("remainder") != std::string::npos, left > 0.0) << remarks;
  }
  for (const char* one : {"1e0", "+1", "1.", "01", "0.1e1", "10E-1"}) {
    EXPECT_EQ(loadCase("climb_printed", {{"flaps", one}, {"fluid", "quasi_steady"}}, CONFIG_DIR)
                  .time.steps,
              500u)
        << one;
  }
  for (const char* bad : {"0", "-1", "1e400", "inf", "nan"})
    expectHas(faults("climb_printed", {{"flaps", bad}}), std::string("time/flaps = ") + bad);
  expectHas(faults("climb_printed", {{"flaps", "1e400"}}), "must be a finite number > 0");
  expectHas(faults("climb_printed", {{"flaps", "0.001"}}),
            "time/flaps amounts to 0.5 steps: must be 1 to");
}

/// The number behind `words` in a message.
double numberAfter(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  EXPECT_NE(at, std::string::npos) << words << " is not in: " << text;
  return at == std::string::npos ? 0.0 : std::stod(text.substr(at + words.size()));
}

TEST_F(CaseTest, AHingeTooStiffForTheTimeStepIsRefused) {
  // 20 us at the wing's own inertia, 29 us with the air's; the step is 196 us.
  const auto stiff = [&](double kappa, int steps) {
    std::string text = monarch(fourier("[1.3, 0, -0.562]"));
    std::ostringstream insect;
    insect.precision(12);
    insect << "monarch_paper, wing: {kappa: " << kappa << "}";
    text = replaced(text, "monarch_paper", insect.str());
    return faults(write("stiff.yaml", replaced(text, "500", std::to_string(steps))));
  };
  const std::string text = stiff(700, 500);
  expectHas(text, "insect/wing/kappa = 700 N m/rad: the free wing swings in 2.92086e-05 s");
  const double kappa = numberAfter(text, "take kappa <= ");
  const double steps = numberAfter(text, "steps_per_flap >= ");
  EXPECT_EQ(stiff(0.999 * kappa, 500), "");
  EXPECT_NE(stiff(1.001 * kappa, 500), "");
  EXPECT_EQ(stiff(700, static_cast<int>(steps)), "");
  EXPECT_NE(stiff(700, static_cast<int>(steps) - 1), "");
  EXPECT_EQ(stiff(0, 20), "");  // no spring, no swing
  // A prescribed pitch has no swing either.
  std::string led = replaced(monarch(fourier("[1.3, 0, -0.562]")), "monarch_paper",
                             "monarch_paper, wing: {kappa: 700}");
  EXPECT_EQ(faults(write("led.yaml", replaced(led, "wing_pitch: true", "wing_pitch: false"))), "");
}

TEST_F(CaseTest, AStepThatIsCoarseForTheHingeIsRemarked) {
  const auto remarks = [&](const std::string& more, const std::string& wings) {
    const std::string text =
        replaced(monarch(fourier("[1.3, 0, -0.562]")), "monarch_paper", "monarch_paper" + more);
    const Case c = loadCase(write("coarse.yaml", text + wings), {}, CONFIG_DIR);
    std::string all;
    for (const std::string& remark : runRemarks(c, c.time.steps)) all += remark;
    return all;
  };
  // 10 steps at 0.155 N m/rad.
  const std::string text = remarks(", wing: {kappa: 0.07}", "");
  expectHas(text, "(insect/wing/kappa) in 0.00292 s, which has only 14.9 time steps");
  expectHas(text, "about 4.51 % off; for 1 % take dt <= ");
  EXPECT_NEAR(numberAfter(text, "steps_per_flap >= "), 500 * 30 / 14.9, 2.0);
  EXPECT_NE(remarks(", wing: {kappa: 0.0175}", ""), "");
  EXPECT_EQ(remarks(", wing: {kappa: 0.017}", ""), "");
  EXPECT_EQ(remarks("", ""), "");
  expectHas(remarks(", left_wing: {kappa: 0.07}", "wings: independent\n"),
            "(insect/left_wing/kappa) in 0.00292 s");
}

TEST_F(CaseTest, AStiffHingeOfOneWingIsRefused) {
  const std::string text = replaced(monarch(fourier("[1.3, 0, -0.562]")), "monarch_paper",
                                    "monarch_paper, left_wing: {kappa: 700}") +
                           "wings: independent\n";
  const std::string fault = faults(write("stiff.yaml", text));
  expectHas(fault, "insect/left_wing/kappa = 700 N m/rad: the free wing swings in 2.92086e-05 s");
  EXPECT_EQ(fault.find("insect/wing/kappa"), std::string::npos) << fault;
}

TEST_F(CaseTest, AdditionsCountInTheStiffnessOfTheHinge) {
  const auto with = [&](const std::string& wing) {
    return faults(
        write("stiff.yaml", replaced(monarch(fourier("[1.3, 0, -0.562]")), "monarch_paper",
                                     "monarch_paper, wing: {kappa: 0, " + wing + "}")));
  };
  EXPECT_EQ(with("hinge_additions: {damping: 700}"), "");  // it does not swing
  for (const char* additions :
       {"cubic_stiffness: 233.333333333", "stop_high: 1, stop_stiffness: 700"}) {
    const std::string text = with("hinge_additions: {" + std::string(additions) + "}");
    expectHas(text,
              "kappa = 0 N m/rad with its hinge_additions: the free wing swings in 2.92086e-05");
    expectHas(text, "take kappa + 3 cubic_stiffness + stop_stiffness <= ");
  }
}

TEST_F(CaseTest, AWingThatTurnsTooFarInAStepIsRefused) {
  const auto started = [&](double rate, int steps) {
    std::ostringstream text;
    text << replaced(monarch(fourier("[1.3, 0, -0.562]")), "500", std::to_string(steps))
         << "initial: {theta_B_dot: " << rate << "}\n";
    return faults(write("started.yaml", text.str()));
  };
  EXPECT_EQ(started(20, 500), "");
  const std::string text = started(8000, 500);  // 1.6 rad in 196 us
  expectHas(text, "time: the wing turns by up to ");
  expectHas(text, "must be <= 1; take dt <= ");
  EXPECT_EQ(started(8000, static_cast<int>(numberAfter(text, "steps_per_flap >= "))), "");
  std::string plate(kPlate);
  plate = replaced(plate, "dt: 0.02, duration: 1", "dt: 0.1, duration: 1");
  plate = replaced(plate, "navier_stokes", "quasi_steady");
  plate +=
      "motion: {type: fourier, frequency: 2, phi_deg: {A0: 0, AN: [60], BN: [0], multiple: 1}, "
      "psi_deg: 0, theta_R_deg: 0, theta_B_deg: 0, "
      "body: {position: [0, 0, 0], velocity: [1, 0, 0]}}\n";
  expectHas(faults(write("plate.yaml", plate)),
            "time: the wing turns by up to 1.25154 rad in a step of dt = 0.1 s: must be <= 1; take "
            "dt <= 0.0799");
}

TEST_F(CaseTest, ShippedCasesFlyAtFewStepsAFlap) {
  for (const char* name :
       {"climb_printed", "climb_fwuav", "climb_trimmed", "climb", "climb_standard", "passive_pitch",
        "measured_motion", "tethered_fwuav", "hinge"}) {
    for (const char* steps : {"25", "100", "250", "1000"}) {
      EXPECT_EQ(faults(name, {{"fluid", "quasi_steady"}, {"steps_per_flap", steps}}), "")
          << name << ' ' << steps;
    }
  }
}

}  // namespace
}  // namespace monarch_flight
