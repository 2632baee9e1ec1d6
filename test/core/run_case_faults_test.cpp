#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "core/case_fixture.h"
#include "monarch_flight/run/pressure_reference.h"
#include "monarch_flight/run/wing_speeds.h"

namespace monarch_flight {
namespace {

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
                           "watchdog_s is given twice (lines 14 and 15); remove one of them",
                           "extra is not a known key",
                           "foo:=1 is not a known override"}) {
    expectHas(text, part);
  }
}

TEST_F(CaseTest, TwinsOfAPresetAreNamedWithItsFile) {
  const fs::path config = folder_ / "config";
  fs::copy(CONFIG_DIR, config, fs::copy_options::recursive);
  const fs::path preset = config / "insects" / "monarch_paper.yaml";
  std::ofstream(preset, std::ios::app) << "\nextra: {mass: 1,\n  mass: 2}\n";
  std::ifstream in(preset);
  const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
  try {
    loadCase("climb_printed", {}, config.string());
    FAIL() << "a twin was not seen";
  } catch (const InputError& e) {
    expectHas(e.what(), preset.string() + ": extra/mass is given twice (lines " +
                            std::to_string(lines - 1) + " and " + std::to_string(lines) + ")");
  }
}

TEST_F(CaseTest, PrescribedFlapsThatAreNone) {
  const auto with = [&](const char* text) {
    return faultsWith("climb", "prescribed_flaps: 1", text);
  };
  EXPECT_EQ(with("prescribed_flaps: 0.5"), "");
  for (const char* bad : {"prescribed_flaps: -1", "prescribed_flaps: nan", "prescribed_flaps: [1]"})
    expectHas(with(bad), ": must be a number of flaps from 0 to 1e6; 1 is usual");
  expectHas(with("prescribed_flaps: 1\n  prescribed_steps: 5"),
            "coupling/prescribed_flaps: prescribed_steps is given, too; remove one of them");
  EXPECT_EQ(with("prescribed_flaps: 1e6"), "");
  const std::string long_start =
      write("long.yaml",
            "insect: {preset: monarch_paper}\ncoupling: {prescribed_flaps: 1e6}\n"
            "time: {steps_per_flap: 5000, flaps: 1}\n");
  expectHas(faults(long_start),
            "coupling/prescribed_flaps = 1e6 amounts to more than 2147483647 steps");
  for (const char* bad : {"steps_per_flap: abc", "steps_per_flap: -5"}) {
    const std::string text = faultsWith("climb", "steps_per_flap: 500", bad);
    expectHas(text, "time/steps_per_flap");
    EXPECT_EQ(text.find("prescribed"), std::string::npos) << text;
  }
  expectHas(faultsWith("climb", "steps_per_flap: 500\n  flaps: 7", "dt: 0.0002\n  duration: 0.1"),
            "coupling/prescribed_flaps: needs time/steps_per_flap; give prescribed_steps instead");
}

TEST_F(CaseTest, FilesAndNames) {
  expectHas(faults("nope"),
            "one of climb, climb_controlled, climb_fwuav, climb_measured, climb_printed, "
            "climb_settled, climb_standard, climb_trimmed, climb_turning, cruise_bumblebee, hinge, "
            "hover_fruit_fly, hover_hawkmoth, measured_motion, passive_pitch, "
            "passive_pitch_identified, plate_re100, tethered_fwuav");
  expectHas(faults("/nonexistent/case.yaml"), "/nonexistent/case.yaml does not exist");
  expectHas(faults(write("syntax.yaml", "a: [1\n")), "is not YAML");
  expectHas(faults(write("list.yaml", "[1, 2]\n")), "holds no keys");
  expectHas(faultsWith("climb_printed", "preset: monarch_paper", "preset: bee"),
            "insect/preset = 'bee'");
  expectHas(
      faultsWith("climb_printed", "series: monarch", "series: bee"),
      "bee_kinematics.yaml does not exist; there are bumblebee, fruit_fly, hawkmoth, monarch");
  expectHas(faultsWith("hinge", "whitney_wood_wing.csv", "absent.csv"),
            "absent.csv: cannot be read");
  EXPECT_EQ(faultsWith("hinge", "mass: 6.0e-7", "mass: 7.0e-7"), "");
}

TEST_F(CaseTest, ACaseThatHoldsItselfIsRefused) {
  const std::string self = write("self.yaml", "name: a\ninsect: &i {kind: bare_wing, wing: *i}\n");
  expectHas(faults(self), "self.yaml: line 2, column 36 is an alias");
  std::string laughs = "a0: &a0 [1, 2]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = "*a" + std::to_string(i - 1), next = "a" + std::to_string(i);
    laughs += next + ": &" + next + " [" + last + ", " + last + "]\n";
  }
  expectHas(faults(write("laughs.yaml", laughs)), "is an alias");
  EXPECT_THROW(caseFromText("a: &a {b: *a}", "text", {}, CONFIG_DIR), InputError);
  expectHas(faults(write("deep.yaml", "a: " + std::string(40, '[') + std::string(40, ']'))),
            "is nested deeper than 32 levels");
  expectHas(faults(write("deeper.yaml", "a: " + std::string(100000, '['))), "nested deeper");
}

TEST_F(CaseTest, AdditionsToTheHinge) {
  const auto with = [&](const std::string& additions) {
    return faultsWith("hinge", "kappa: 9.0e-6",
                      "kappa: 9.0e-6\n    hinge_additions: {" + additions + "}");
  };
  EXPECT_EQ(with("damping: 1e-9, cubic_stiffness: 1e-6"), "");
  EXPECT_EQ(with("stop_low: -1, stop_stiffness: 1e-5"), "");
  const std::string all =
      with("damping: -1, cubic_stiffness: -2, stop_low: 1, stop_high: 0.5, stop_stiffness: -3");
  for (const char* part : {"insect/wing/hinge_additions/damping = -1 N m s/rad: must be >= 0",
                           "hinge_additions/cubic_stiffness = -2 N m/rad3: must be >= 0",
                           "hinge_additions/stop_stiffness = -3 N m/rad: must be >= 0",
                           "hinge_additions/stop_low = 1 rad: must be < stop_high"})
    expectHas(all, part);
  expectHas(with("stop_low: -60, stop_stiffness: 1e-5"), "stop_low = -60 rad: must be within +-pi");
  expectHas(with("stop_high: 1"), "stop_stiffness = 0 N m/rad: must be > 0 where there is a stop");
  expectHas(with("dampng: 1"), "insect/wing/hinge_additions/dampng");
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
  expectHas(faultsWith("plate_re100", "span: 2", "span: 2\n      sweep: 1.2"),
            "insect/wing/planform/sweep = 1.2 rad: must be within +-pi/3");
  expectHas(faultsWith("plate_re100", "span: 2", "span: 2\n      swep: 0.1"), "did you mean");
  expectHas(faultsWith("plate_re100", "dt: 0.02\n  duration: 10", "steps_per_flap: 10\n  flaps: 1"),
            "this motion has no flapping period");
  expectHas(faultsWith("plate_re100", "dt: 0.02", "dt: 0"), "time/dt = 0 s: must be > 0");
  expectHas(
      faultsWith("plate_re100", "phi_deg: 0", "phi_deg: {A0: 0, AN: [1], BN: [0], multiple: 1}"),
      "motion/phi_deg/AN: harmonics need motion/frequency > 0");
  expectHas(faultsWith("hinge", "BN: [0]", "BN: []"), "motion/phi_deg/BN has 0 values");
  expectHas(faultsWith("climb_printed", "velocity: [1.3, 0, -0.562]\n  theta_B",
                       "velocity: [1.3, 0.1, -0.562]\n  theta_B"),
            "initial/velocity[1] = 0.1 m/s: must be 0 while only one wing is solved and mirrored");
  expectHas(faultsWith("hinge", "free:", "initial: {theta_B: 0.1}\nfree:"),
            "initial/theta_B = 0.1: free/pitch is false");
}

TEST_F(CaseTest, CourantEstimateRefusesTooLargeSteps) {
  // Plate: 1 m/s, cell 1/16 m, limit 3: dt up to 0.1875 s.
  EXPECT_EQ(faultsWith("plate_re100", "dt: 0.02", "dt: 0.187"), "");
  const std::string text = faultsWith("plate_re100", "dt: 0.02", "dt: 0.2");
  expectHas(text, "Courant number of 3.2");
  expectHas(text, "grid/courant_limit = 3; take dt <= 0.1875 s");
  expectHas(faults("climb_printed", {{"steps_per_flap", "20"}}), "take steps_per_flap >= ");
  EXPECT_EQ(faults("climb_printed", {{"steps_per_flap", "20"}, {"fluid", "quasi_steady"}}), "");
}

TEST_F(CaseTest, AWingThatIsSlowAtItsTipIsFastElsewhere) {
  // The tip lies on the root, which flaps: its outline is fastest at y = -2.
  std::string flapping(kPlate);
  flapping.replace(flapping.find("root_offset: 0"), 14, "root_offset: -2");
  flapping +=
      "motion: {type: fourier, frequency: 1, phi_deg: {A0: 0, AN: [0], BN: [60], multiple: 1}, "
      "psi_deg: 0, theta_R_deg: 0, theta_B_deg: 0, "
      "body: {position: [0, 0, 0], velocity: [0, 0, 0]}}\n";
  // 60 deg * 2 pi * 2 m = 13.2 m/s at cells of 1/16 m: dt = 0.02 s gives 4.2.
  const std::string fast = faults(write("fast.yaml", flapping));
  expectHas(fast, "Courant number of 4.2");
  flapping.replace(flapping.find("dt: 0.02"), 8, "dt: 0.01");
  const Case c = loadCase(write("slower.yaml", flapping), {}, CONFIG_DIR);
  const double fastest = M_PI / 3 * 2 * M_PI * 2.0;
  EXPECT_NEAR(peakWingSpeeds(c).outline, fastest, 1e-3 * fastest);
  EXPECT_EQ(peakWingSpeeds(c).root, 0.0);
  EXPECT_NEAR(pressureReference(c).speed, fastest, 1e-3 * fastest);
  EXPECT_NEAR(vortexThreshold(c), 0.1 * fastest * fastest, 0.01 * fastest * fastest);
}

TEST_F(CaseTest, HugeRunsAreReadAtOnce) {
  // 2^32 - 1 steps, the most there may be.
  std::string longest(kPlate);
  longest.replace(longest.find("duration: 1"), 11, "duration: 85899345.9");
  longest +=
      "motion: {type: fourier, frequency: 0, phi_deg: 0, psi_deg: 0, theta_R_deg: 0, "
      "theta_B_deg: 0, body: {position: [0, 0, 0], velocity: [1, 0, 0]}}\n";
  const Case c = loadCase(write("longest.yaml", longest), {}, CONFIG_DIR);
  EXPECT_EQ(c.time.steps, 4294967295u);
  EXPECT_DOUBLE_EQ(peakWingSpeeds(c).outline, 1.0);
}

TEST_F(CaseTest, NamesAndTimesThatWouldGoWrongLater) {
  expectHas(faultsWith("hinge", "name: whitney_wood_wing", "name: \"a<b\""),
            "insect/name = 'a<b': must consist of letters");
  expectHas(faultsWith("hinge", "name: whitney_wood_wing", "name: " + std::string(400000, 'a')),
            "insect/name has 400000 characters: must be at most 200");
  expectHas(faultsWith("plate_re100", "dt: 0.02", "t_start: 1e9\n  dt: 0.02"),
            "time/t_start = 1000000000 s: the run reaches to");
  EXPECT_EQ(faultsWith("plate_re100", "dt: 0.02", "t_start: 1e3\n  dt: 0.02"), "");
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
