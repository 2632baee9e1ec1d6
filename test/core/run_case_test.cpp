#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed at its end.
class CaseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("monarch_case_" + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  /// The message of the InputError, or "" when the case loads.
  static std::string faults(const std::string& path, const CaseOverrides& overrides = {}) {
    try {
      loadCase(path, overrides, CONFIG_DIR);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  /// Faults of a shipped case in which `from` (which must occur) is replaced by `to`.
  std::string faultsWith(const std::string& shipped, const std::string& from,
                         const std::string& to) const {
    std::ifstream in(std::string(CONFIG_DIR) + "/cases/" + shipped + ".yaml");
    std::stringstream text;
    text << in.rdbuf();
    std::string content = text.str();
    const std::size_t at = content.find(from);
    if (at == std::string::npos) return "the case does not hold: " + from;
    content.replace(at, from.size(), to);
    // The case names its files relative to its own folder.
    fs::create_directories(folder_ / "cases");
    fs::copy(std::string(CONFIG_DIR) + "/insects", folder_ / "insects",
             fs::copy_options::overwrite_existing | fs::copy_options::recursive);
    return faults(write("cases/changed.yaml", content));
  }
  fs::path folder_;
};

void expectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n" << text;
}

constexpr char kPlate[] = R"(
name: plate
insect:
  kind: bare_wing
  name: plate
  beta: 0
  wing:
    mass: 0
    kappa: 0
    theta_0: 0
    planform: {type: rectangle, chord: 1, span: 2, hinge: 0.5, root_offset: 0}
fluid: {solver: navier_stokes, density: 1, viscosity: 0.01, gravity: 0}
free: {x: false, z: false, pitch: false, wing_pitch: false}
time: {dt: 0.02, duration: 1}
)";

std::string wingRows(int n, double dt, int broken_row = -1) {
  std::ostringstream text;
  text.precision(17);
  text << "t,x,y,z,qw,qx,qy,qz\n";
  for (int i = 0; i < n; ++i) {
    const double t = i * dt, half = 0.1 * std::sin(t);
    text << (i == broken_row ? t - 2 * dt : t) << ',' << t << ",0,0," << std::cos(half) << ",0,"
         << std::sin(half) << ",0\n";
  }
  return text.str();
}

TEST_F(CaseTest, EveryShippedCaseLoads) {
  for (const char* name : {"climb", "climb_fwuav", "tethered_fwuav", "hinge", "plate_re100"}) {
    const Case c = loadCase(name, {}, CONFIG_DIR);
    EXPECT_EQ(c.name, name);
    EXPECT_EQ(c.sha256.size(), 64u);
    EXPECT_TRUE(c.insect.problems().empty());
    EXPECT_TRUE(c.coupling.problems().empty());
    EXPECT_GT(c.time.steps, 0u);
    EXPECT_DOUBLE_EQ(c.coupling.length_scale, c.insect.planform.meanChord());
    EXPECT_NO_THROW(c.motion->at(c.time.time(c.time.steps)));
  }
}

TEST_F(CaseTest, ClimbIsThePapersFlight) {
  const Case c = loadCase("climb", {}, CONFIG_DIR);
  EXPECT_EQ(c.free.count(), 4);
  EXPECT_NEAR(c.insect.planform.span(), 0.052, 1e-15);
  EXPECT_NEAR(c.insect.planform.area(), 15.2e-4, 1e-14);
  EXPECT_DOUBLE_EQ(c.insect.m_B, 220e-6);
  EXPECT_DOUBLE_EQ(c.insect.right.m, 36.25e-6);
  EXPECT_DOUBLE_EQ(c.insect.left.nu.y(), -c.insect.right.nu.y());
  EXPECT_DOUBLE_EQ(c.insect.kappa, 1.5e-4);
  EXPECT_DOUBLE_EQ(c.insect.beta, 25.4292 * M_PI / 180.0);
  EXPECT_EQ(c.coupling.prescribed_steps, 10);
  EXPECT_EQ(c.coupling.tolerance, 1e-8);
  EXPECT_EQ(c.time.steps, 1000u);
  EXPECT_DOUBLE_EQ(c.time.stepsPerFlap(), 500.0);
  const PrescribedState start = c.motion->at(0.0);
  EXPECT_LT((start.body.v - Eigen::Vector3d(1.3, 0, -0.562)).norm(), 1e-15);
  // Sum of the cosine coefficients of the flapping angle.
  EXPECT_NEAR(start.angles.phi.q * 180.0 / M_PI,
              -0.83724 + 59.7558745992612 - 0.137466978762473 + 0.137978226025185 +
                  0.433746159939459 - 0.074830919096204,
              1e-10);
  // Deviation runs at twice the flapping frequency.
  EXPECT_NEAR(c.motion->at(0.0).angles.psi.q, c.motion->at(0.5 / 10.2).angles.psi.q, 1e-12);
}

TEST_F(CaseTest, PlateHasLengthsOfOrderOne) {
  const Case c = loadCase("plate_re100", {}, CONFIG_DIR);
  EXPECT_TRUE(c.insect.bare_wing);
  EXPECT_EQ(c.time.steps, 500u);
  EXPECT_EQ(c.time.period, 0.0);
  EXPECT_NEAR(c.air.rho * 1.0 * c.insect.planform.meanChord() / c.air.mu, 100.0, 1e-10);
  const PrescribedState s = c.motion->at(1.0);
  const WingMotion wing = rightWingMotion(c.insect, s.body, s.angles);
  EXPECT_NEAR(wing.r_I.x(), 1.0, 1e-15);
  // Incidence of 30 deg: the wing moves along its chord and towards its lower side.
  EXPECT_NEAR(wing.v_W.x(), std::cos(M_PI / 6.0), 1e-15);
  EXPECT_NEAR(wing.v_W.z(), std::sin(M_PI / 6.0), 1e-15);
}

TEST_F(CaseTest, ResolvedCaseLoadsToItselfBitForBit) {
  for (const char* name : {"climb", "climb_fwuav", "tethered_fwuav", "hinge", "plate_re100"}) {
    const Case c = loadCase(name, {{"record", "false"}}, CONFIG_DIR);
    const Case again = loadCase(write("resolved.yaml", c.resolved_yaml), {}, CONFIG_DIR);
    EXPECT_EQ(again.resolved_yaml, c.resolved_yaml);
    EXPECT_EQ(again.sha256, c.sha256);
    EXPECT_EQ(again.time.dt, c.time.dt);
    EXPECT_EQ(again.insect.right.J, c.insect.right.J);
    EXPECT_EQ(again.motion->at(0.0123).angles.phi.qdd, c.motion->at(0.0123).angles.phi.qdd);
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
  EXPECT_LT((body.R_IB - rotationY(0.2 * std::sin(0.5))).norm(), 1e-12);
  EXPECT_NEAR(body.Omega_B.y(), 0.2 * std::cos(0.5), 1e-10);
  EXPECT_NEAR(body.v.x(), 1.0, 1e-12);
  fs::remove(folder_ / "flight.csv");  // the resolved case stands alone
  const Case again = loadCase(write("resolved.yaml", c.resolved_yaml), {}, CONFIG_DIR);
  EXPECT_EQ(again.resolved_yaml, c.resolved_yaml);
  EXPECT_EQ(again.sha256, c.sha256);
  EXPECT_EQ(again.motion->at(0.123).body.Omega_dot_B, c.motion->at(0.123).body.Omega_dot_B);
}

TEST_F(CaseTest, OverridesFromTheCommandLine) {
  const Case c = loadCase("climb",
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
  const Case preview = loadCase("climb", {}, CONFIG_DIR);
  const Case fine =
      loadCase(write("resolved.yaml", preview.resolved_yaml), {{"grid", "fine"}}, CONFIG_DIR);
  EXPECT_EQ(fine.grid.first_cell, GridSettings::preset("fine").first_cell);
  expectHas(faults("climb", {{"speed", "3"}}), "speed:=3 is not a known override");
  expectHas(faults("climb", {{"fluid", "dns"}}), "fluid/solver = 'dns': must be one of");
  expectHas(faults("climb", {{"flaps", "-1"}}), "time/flaps = -1: must be > 0");
  expectHas(faults("climb", {{"steps_per_flap", "2.5"}}), "must be a whole number");
  expectHas(faults("climb", {{"record", "maybe"}}),
            "output/record = 'maybe': must be true or false");
  expectHas(faults("plate_re100", {{"flaps", "2"}}), "not both");
}

TEST_F(CaseTest, PresetKeysAreOverriddenOneByOne) {
  const std::string path = write("heavy.yaml", R"(
name: heavy
insect:
  preset: monarch_paper
  wing: {mass: 7.25e-5}
fluid: {solver: quasi_steady}
motion: {type: fourier, series: monarch, frequency: 10.2, psi_deg: 0,
         body: {position: [0, 0, 0], velocity: [1, 0, 0]}}
free: {x: true, z: true, pitch: true, wing_pitch: true}
initial: {theta_B: 0.35, theta_B_dot: 14.8, velocity: [0.893, 0, -0.952]}
time: {steps_per_flap: 500, flaps: 1}
)");
  const Case c = loadCase(path, {}, CONFIG_DIR);
  const Case nominal = loadCase("climb", {}, CONFIG_DIR);
  EXPECT_LT((c.insect.right.J - 2.0 * nominal.insect.right.J).norm(), 1e-20);
  EXPECT_EQ(c.insect.m_B, nominal.insect.m_B);
  EXPECT_EQ(c.motion->at(0.01).angles.psi.qd, 0.0);
  EXPECT_NE(c.motion->at(0.01).angles.phi.qd, 0.0);
  const PrescribedState s = c.motion->at(0.002);
  EXPECT_DOUBLE_EQ(s.body.pitch.q, 0.35 + 14.8 * 0.002);
  EXPECT_EQ(s.body.pitch.qdd, 0.0);
  EXPECT_DOUBLE_EQ(s.body.x.z(), -0.952 * 0.002);
  EXPECT_NE(s.angles.theta.qdd, 0.0);  // theta_R still follows the series
}

TEST_F(CaseTest, AllFaultsAtOnce) {
  const std::string text = faults(write("bad.yaml", R"(
name: bad name!
insect:
  preset: monarch_paper
  wing: {mass: -1, masss: 2, planform: {type: rectangle, chord: 1e-2, span: 0, hinge: 0}}
  body: 3
fluid: {solver: dns, density: .inf, gravity: abc, wind: [0, 0]}
grid: {level: preview, margin: -1, outer: closed}
motion: {type: fourier, series: monarch, frequency: -3, body: {position: [0, 0, nan], velocity: 1}}
initial: {theta_R: x}
free: {x: yes, z: true, pitch: true}
time: {steps_per_flap: 2.5, flaps: 0, foo: 1}
coupling: {tolerance: -1}
watchdog_s: 0
watchdog_s: 1
extra: 1
)"),
                                  {{"foo", "1"}});
  for (const char* part : {"name = 'bad name!'",
                           "insect/wing/mass = -1 kg: must be > 0",
                           "insect/wing/masss is not a known key",
                           "insect/wing/planform/span = 0 m: must be > 0",
                           "insect/wing/planform/root_offset is missing",
                           "insect/body = '3': must be a section",
                           "fluid/solver = 'dns'",
                           "fluid/density = '.inf': must be a number",
                           "fluid/gravity = 'abc'",
                           "fluid/wind has 2 values: must be 3",
                           "grid/margin = -1",
                           "coupling/tolerance = -1",
                           "grid/outer",
                           "motion/frequency = -3 Hz: must be >= 0",
                           "motion/body/position[2] = nan m: must be a finite number",
                           "motion/body/velocity = '1': must be a list",
                           "initial/theta_R = 'x'",
                           "free/x = 'yes'",
                           "free/wing_pitch is missing",
                           "time/steps_per_flap = 2.5",
                           "time/flaps = 0",
                           "time/foo is not a known key",
                           "watchdog_s is given twice",
                           "extra is not a known key",
                           "foo:=1 is not a known override"}) {
    expectHas(text, part);
  }
}

TEST_F(CaseTest, FilesAndNames) {
  expectHas(faults("nope"), "one of climb, climb_fwuav, hinge, plate_re100, tethered_fwuav");
  expectHas(faults("/nonexistent/case.yaml"), "/nonexistent/case.yaml does not exist");
  expectHas(faults(write("syntax.yaml", "a: [1\n")), "is not YAML");
  expectHas(faults(write("list.yaml", "[1, 2]\n")), "holds no keys");
  expectHas(faultsWith("climb", "preset: monarch_paper", "preset: bee"), "insect/preset = 'bee'");
  expectHas(faultsWith("climb", "series: monarch", "series: bee"),
            "bee_kinematics.yaml does not exist; there are monarch");
  expectHas(faultsWith("hinge", "whitney_wood_wing.csv", "absent.csv"),
            "absent.csv: cannot be read");
  EXPECT_EQ(faultsWith("hinge", "mass: 6.0e-7", "mass: 7.0e-7"), "");
}

TEST_F(CaseTest, NonPhysicalValues) {
  expectHas(faultsWith("hinge", "mass: 6.0e-7", "mass: -6.0e-7"), "insect/wing/mass = -6e-07 kg");
  expectHas(faultsWith("hinge", "mass: 6.0e-7", "mass: 0"),
            "insect/wing/mass = 0 kg: must be > 0 kg when free/wing_pitch is true");
  expectHas(faultsWith("hinge", "kappa: 9.0e-6", "kappa: -1"), "insect/wing/kappa = -1 N m/rad");
  expectHas(faultsWith("hinge", "kappa: 9.0e-6", "kappa: nan"),
            "insect/wing/kappa = nan N m/rad: must be a finite number");
  expectHas(faultsWith("hinge", "  x: false", "  x: true"), "free/x = true: must be false");
  expectHas(faultsWith("plate_re100", "span: 2", "span: 0"), "insect/wing/planform/span = 0 m");
  expectHas(faultsWith("plate_re100", "chord: 1", "chord: .nan"), "insect/wing/planform/chord");
  expectHas(faultsWith("plate_re100", "dt: 0.02\n  duration: 10", "steps_per_flap: 10\n  flaps: 1"),
            "this motion has no flapping period");
  expectHas(faultsWith("plate_re100", "dt: 0.02", "dt: 0"), "time/dt = 0 s: must be > 0");
  expectHas(
      faultsWith("plate_re100", "phi_deg: 0", "phi_deg: {A0: 0, AN: [1], BN: [0], multiple: 1}"),
      "motion/phi_deg/AN: harmonics need motion/frequency > 0");
  expectHas(faultsWith("hinge", "BN: [0]", "BN: []"), "motion/phi_deg/BN has 0 values");
  expectHas(faultsWith("climb", "velocity: [1.3, 0, -0.562]\n  theta_B",
                       "velocity: [1.3, 0.1, -0.562]\n  theta_B"),
            "initial/velocity[1] = 0.1: this coordinate is not free");
  expectHas(faultsWith("hinge", "free:", "initial: {theta_B: 0.1}\nfree:"),
            "initial/theta_B = 0.1: free/pitch is false");
}

TEST_F(CaseTest, CourantEstimateRefusesTooLargeSteps) {
  // Plate: 1 m/s, cell 1/16 m, limit 3: dt up to 0.1875 s.
  EXPECT_EQ(faultsWith("plate_re100", "dt: 0.02", "dt: 0.187"), "");
  const std::string text = faultsWith("plate_re100", "dt: 0.02", "dt: 0.2");
  expectHas(text, "Courant number of 3.2");
  expectHas(text, "grid/courant_limit = 3; take dt <= 0.1875 s");
  expectHas(faults("climb", {{"steps_per_flap", "20"}}), "take steps_per_flap >= ");
  EXPECT_EQ(faults("climb", {{"steps_per_flap", "20"}, {"fluid", "quasi_steady"}}), "");
}

TEST_F(CaseTest, GridThatCannotHoldTheWingIsRefused) {
  EXPECT_NE(faultsWith("plate_re100", "level: preview", "level: preview\n  cells_per_chord: 1"),
            "");
  expectHas(faultsWith("plate_re100", "level: preview", "level: custom"),
            "grid/cells_per_chord is missing");
}

TEST_F(CaseTest, MotionTables) {
  const std::string table = "motion: {type: table, kind: wing, frequency: 0, file: m.csv}\n";
  const std::string path = write("plate.yaml", std::string(kPlate) + table);
  expectHas(faults(path), "m.csv: cannot be read");
  write("m.csv", wingRows(51, 0.01));
  expectHas(faults(path), "the table reaches from 0 to 0.5 s: must cover the run from 0 to 1 s");
  write("m.csv", wingRows(101, 0.01, 20));
  expectHas(faults(path), "m.csv: row 21, column t");
  write("m.csv", "t,x,y,z,qw,qx,qy\n0,0,0,0,1,0,0\n");
  expectHas(faults(path), "column 'qz' is missing");
  write("m.csv", wingRows(101, 0.01));
  EXPECT_EQ(faults(path), "");
  std::string tilted = std::string(kPlate) + table;
  tilted.replace(tilted.find("beta: 0"), 7, "beta: 1");
  expectHas(faults(write("tilted.yaml", tilted)),
            "insect/beta = 1 rad: must be 0 with motion/kind wing");
  const std::string butterfly = R"(
name: carried
insect: {preset: monarch_fwuav}
fluid: {solver: quasi_steady}
motion: {type: table, kind: wing, frequency: 0, file: m.csv}
free: {x: false, z: false, pitch: false, wing_pitch: false}
time: {dt: 0.001, duration: 0.1}
)";
  expectHas(faults(write("carried.yaml", butterfly)), "motion/kind = 'wing': must be body");
}

}  // namespace
}  // namespace monarch_flight
