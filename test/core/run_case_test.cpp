#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/case_fixture.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

TEST_F(CaseTest, EveryShippedCaseLoads) {
  for (const char* name : {"climb_printed", "climb_fwuav", "climb_trimmed", "tethered_fwuav",
                           "hinge", "plate_re100"}) {
    const Case c = loadCase(name, {}, CONFIG_DIR);
    EXPECT_EQ(c.name, name);
    EXPECT_EQ(c.sha256.size(), 64u);
    EXPECT_TRUE(c.insect.problems().empty());
    EXPECT_TRUE(c.coupling.problems().empty());
    EXPECT_GT(c.time.steps, 0u);
    EXPECT_DOUBLE_EQ(c.coupling.length_scale, c.insect.wings.right.planform.meanChord());
    EXPECT_NO_THROW(c.motion->at(c.time.time(c.time.steps)));
  }
}

TEST_F(CaseTest, PrescribedFlapsFollowTheTimeStep) {
  for (const int steps : {100, 250, 1000}) {
    const Case c =
        loadCase("climb_controlled", {{"steps_per_flap", std::to_string(steps)}}, CONFIG_DIR);
    EXPECT_EQ(c.coupling.prescribed_steps, steps);
    EXPECT_NE(c.resolved_yaml.find("prescribed_steps: " + std::to_string(steps)),
              std::string::npos);
    EXPECT_EQ(c.resolved_yaml.find("prescribed_flaps"), std::string::npos);
  }
}

TEST_F(CaseTest, ClimbIsThePapersFlight) {
  const Case c = loadCase("climb_printed", {}, CONFIG_DIR);
  EXPECT_EQ(c.free.count(), 4);
  EXPECT_NEAR(c.insect.wings.right.planform.span(), 0.052, 1e-15);
  EXPECT_NEAR(c.insect.wings.right.planform.area(), 15.2e-4, 1e-14);
  EXPECT_DOUBLE_EQ(c.insect.m_B, 220e-6);
  EXPECT_DOUBLE_EQ(c.insect.wings.right.plate.m, 36.25e-6);
  EXPECT_EQ(c.insect.wings.left.plate.nu, c.insect.wings.right.plate.nu);  // as its mirror image
  EXPECT_DOUBLE_EQ(c.insect.wings.right.kappa, 1.5e-4);
  EXPECT_FALSE(c.insect.wings.right.additions.any());
  EXPECT_NE(c.resolved_yaml.find("stop_high: none"), std::string::npos);
  EXPECT_DOUBLE_EQ(c.insect.beta, 25.4292 * M_PI / 180.0);
  EXPECT_EQ(c.coupling.prescribed_steps, 10);
  EXPECT_EQ(c.coupling.tolerance, 1e-8);
  EXPECT_EQ(c.time.steps, 1000u);
  EXPECT_DOUBLE_EQ(c.time.stepsPerFlap(), 500.0);
  const PrescribedState start = c.motion->at(0.0);
  EXPECT_LT((start.body.v - Eigen::Vector3d(1.3, 0, -0.562)).norm(), 1e-15);
  // Sum of the cosine coefficients of the flapping angle.
  EXPECT_NEAR(start.angles.wings.right.phi.q * 180.0 / M_PI,
              -0.83724 + 59.7558745992612 - 0.137466978762473 + 0.137978226025185 +
                  0.433746159939459 - 0.074830919096204,
              1e-10);
  // Deviation runs at twice the flapping frequency.
  EXPECT_NEAR(start.angles.wings.right.psi.q, c.motion->at(0.5 / 10.2).angles.wings.right.psi.q,
              1e-12);
}

TEST_F(CaseTest, PlateHasLengthsOfOrderOne) {
  const Case c = loadCase("plate_re100", {}, CONFIG_DIR);
  EXPECT_TRUE(c.insect.bare_wing);
  EXPECT_EQ(c.time.steps, 500u);
  EXPECT_EQ(c.time.period, 0.0);
  EXPECT_NEAR(c.air.rho * 1.0 * c.insect.wings.right.planform.meanChord() / c.air.mu, 100.0, 1e-10);
  const PrescribedState s = c.motion->at(1.0);
  const WingMotion wing = wingMotion(Side::kRight, c.insect, s.body, s.angles);
  EXPECT_NEAR(wing.r_I.x(), 1.0, 1e-15);
  // Incidence of 30 deg: the wing moves along its chord and towards its lower side.
  EXPECT_NEAR(wing.v_W.x(), std::cos(M_PI / 6.0), 1e-15);
  EXPECT_NEAR(wing.v_W.z(), std::sin(M_PI / 6.0), 1e-15);
}

TEST_F(CaseTest, ResolvedCaseLoadsToItselfBitForBit) {
  for (const char* name : {"climb_printed", "climb_fwuav", "climb_trimmed", "tethered_fwuav",
                           "hinge", "plate_re100"}) {
    const Case c = loadCase(name, {{"record", "false"}}, CONFIG_DIR);
    const Case again = loadCase(write("resolved.yaml", c.resolved_yaml), {}, CONFIG_DIR);
    EXPECT_EQ(again.resolved_yaml, c.resolved_yaml);
    EXPECT_EQ(again.sha256, c.sha256);
    EXPECT_EQ(again.time.dt, c.time.dt);
    EXPECT_EQ(again.insect.wings.right.plate.J, c.insect.wings.right.plate.J);
    EXPECT_EQ(again.motion->at(0.0123).angles.wings.right.phi.qdd,
              c.motion->at(0.0123).angles.wings.right.phi.qdd);
    EXPECT_FALSE(again.output.record);
  }
}

TEST_F(CaseTest, Sha256IsThatOfTheResolvedText) {
  const Case c = loadCase("hinge", {}, CONFIG_DIR);
  const std::string path = write("resolved.yaml", c.resolved_yaml);
  std::FILE* pipe = popen(("sha256sum '" + path + "'").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  char hex[65] = {};
  EXPECT_EQ(std::fread(hex, 1, 64, pipe), 64u);
  pclose(pipe);
  EXPECT_EQ(c.sha256, hex);
}

TEST_F(CaseTest, TablesAreEmbeddedAndRoundTrip) {
  write("flight.csv", wingRows(101, 0.01));
  const std::string path = write(
      "plate.yaml",
      std::string(kPlate) + "motion: {type: table, kind: wing, frequency: 0, file: flight.csv}\n");
  const Case c = loadCase(path, {}, CONFIG_DIR);
  EXPECT_EQ(c.time.steps, 50u);
  const BodyState body = c.motion->at(0.5).body;
  EXPECT_LT((body.R_IB() - rotationY(0.2 * std::sin(0.5))).norm(), 1e-12);
  EXPECT_NEAR(body.Omega_B.y(), 0.2 * std::cos(0.5), 1e-10);
  EXPECT_NEAR(body.v.x(), 1.0, 1e-12);
  fs::remove(folder_ / "flight.csv");  // the resolved case stands alone
  const Case again = loadCase(write("resolved.yaml", c.resolved_yaml), {}, CONFIG_DIR);
  EXPECT_EQ(again.resolved_yaml, c.resolved_yaml);
  EXPECT_EQ(again.sha256, c.sha256);
  EXPECT_EQ(again.motion->at(0.123).body.Omega_dot_B, c.motion->at(0.123).body.Omega_dot_B);
}

TEST_F(CaseTest, OverridesFromTheCommandLine) {
  const Case c = loadCase("climb_printed",
                          {{"fluid", "quasi_steady"},
                           {"grid", "fine"},
                           {"flaps", "0.5"},
                           {"steps_per_flap", "300"},
                           {"record", "false"}},
                          CONFIG_DIR);
  EXPECT_EQ(c.fluid, FluidKind::kQuasiSteady);
  EXPECT_EQ(c.grid.level, "fine");
  EXPECT_EQ(c.grid.cells_per_chord, GridSettings::preset("fine").cells_per_chord);
  EXPECT_EQ(c.time.steps, 150u);
  EXPECT_DOUBLE_EQ(c.time.dt, 1.0 / (10.2 * 300));
  EXPECT_FALSE(c.output.record);
  // A resolved case takes another level as a whole.
  const Case preview = loadCase("climb_printed", {}, CONFIG_DIR);
  const Case fine =
      loadCase(write("resolved.yaml", preview.resolved_yaml), {{"grid", "fine"}}, CONFIG_DIR);
  EXPECT_EQ(fine.grid.first_cell, GridSettings::preset("fine").first_cell);
  expectHas(faults("climb_printed", {{"speed", "3"}}), "speed:=3 is not a known override");
  expectHas(faults("climb_printed", {{"fluid", "dns"}}), "fluid/solver = 'dns': must be one of");
  expectHas(faults("climb_printed", {{"flaps", "-1"}}), "time/flaps = -1: must be > 0");
  expectHas(faults("climb_printed", {{"steps_per_flap", "2.5"}}), "must be a whole number");
  expectHas(faults("climb_printed", {{"record", "maybe"}}),
            "output/record = 'maybe': must be true or false");
  expectHas(faults("plate_re100", {{"flaps", "2"}}), "not both");
}

TEST_F(CaseTest, PresetKeysAreOverriddenOneByOne) {
  const std::string path = write("heavy.yaml", R"(
name: heavy
insect:
  preset: monarch_paper
  wing: {mass: 7.25e-5, planform: {sweep: 0.2}}
fluid: {solver: quasi_steady}
motion: {type: fourier, series: monarch, frequency: 10.2, psi_deg: 0,
         body: {position: [0, 0, 0], velocity: [1, 0, 0]}}
free: {x: true, z: true, pitch: true, wing_pitch: true}
initial: {theta_B: 0.35, theta_B_dot: 14.8, velocity: [0.893, 0, -0.952]}
time: {steps_per_flap: 500, flaps: 1}
)");
  const Case c = loadCase(path, {}, CONFIG_DIR);
  const Case nominal = loadCase("climb_printed", {}, CONFIG_DIR);
  const Wing &wing = c.insect.wings.right, &unswept = nominal.insect.wings.right;
  EXPECT_NEAR(wing.plate.J(0, 0), 2.0 * unswept.plate.J(0, 0),
              1e-20);  // about the chord's direction
  EXPECT_NEAR(wing.planform.leading(0.03), unswept.planform.leading(0.03) - 0.03 * std::tan(0.2),
              1e-15);
  EXPECT_NE(c.resolved_yaml.find("sweep: 0.2"), std::string::npos);
  EXPECT_EQ(c.insect.m_B, nominal.insect.m_B);
  EXPECT_EQ(c.motion->at(0.01).angles.wings.right.psi.qd, 0.0);
  EXPECT_NE(c.motion->at(0.01).angles.wings.right.phi.qd, 0.0);
  const PrescribedState s = c.motion->at(0.002);
  EXPECT_DOUBLE_EQ(s.body.pitch.q, 0.35 + 14.8 * 0.002);
  EXPECT_EQ(s.body.pitch.qdd, 0.0);
  EXPECT_DOUBLE_EQ(s.body.x.z(), -0.952 * 0.002);
  EXPECT_NE(s.angles.wings.right.theta.qdd, 0.0);  // theta_R still follows the series
}

}  // namespace
}  // namespace monarch_flight
