// fluid/wind of a case: what is read, what is written out, what is refused; and a gust in flight.
#include <gtest/gtest.h>

#include "core/case_fixture.h"
#include "monarch_flight/insect/gusts.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/wing_speeds.h"

namespace monarch_flight {
namespace {

using Eigen::Vector3d;

constexpr char kGusts[] = R"(
    steady: [0.3, 0.1, -0.2]
    gusts:
      - {kind: time, start: 0.2, duration: 0.5, amplitude: [0, 0.4, -1]}
      - {kind: place, start: 0.25, length: 0.5, amplitude: [-0.5, 0, 0.3]}
      - {kind: place, start: 1, length: 2, amplitude: [0, 0, 1], direction: [0, 0, -2]}
    file: wind.csv
)";

/// The plate, at 1 m/s north and 0.5 m/s down, in this wind.
std::string plateIn(const std::string& wind, const std::string& velocity = "[1, 0, 0.5]") {
  std::string text(kPlate);
  const std::string air = "fluid: {solver: navier_stokes, density: 1, viscosity: 0.01, gravity: 0}";
  text.replace(text.find(air), air.size(),
               "fluid:\n  solver: navier_stokes\n  density: 1\n  viscosity: 0.01\n  gravity: 0\n"
               "  wind: " +
                   wind);
  return text +
         "\nmotion: {type: fourier, frequency: 0, phi_deg: 0, psi_deg: 0, theta_R_deg: 0, "
         "theta_B_deg: 0, body: {position: [2, 0, 1], velocity: " +
         velocity + "}}\n";
}

Vector3d breeze(double t) { return {std::sin(3.0 * t), 0.2 * t, 0.1 * std::cos(4.0 * t)}; }

std::string windRows(int n, double dt) {
  std::ostringstream text;
  text.precision(17);
  text << "wx,wz,wy,t\n";  // by name, not by place
  for (int i = 0; i < n; ++i) {
    const Vector3d w = breeze(i * dt);
    text << w.x() << ',' << w.z() << ',' << w.y() << ',' << i * dt << '\n';
  }
  return text.str();
}

/// At the place and speed of the motion.
Wind met(const Case& c, double t) {
  const BodyState body = c.motion->at(t).body;
  return c.wind->at(t, body.x, body.v, body.a);
}

TEST_F(CaseTest, AVectorIsTheSteadyWind) {
  const Case c = loadCase(write("steady.yaml", plateIn("[0.3, -0.1, 0.2]")), {}, CONFIG_DIR);
  EXPECT_EQ(met(c, 0.7).v, Vector3d(0.3, -0.1, 0.2));
  EXPECT_EQ(met(c, 0.7).a, Vector3d::Zero());
  expectHas(c.resolved_yaml, "wind: [0.3, -0.1, 0.2]");
  const Case calm = loadCase("plate_re100", {}, CONFIG_DIR);
  EXPECT_EQ(met(calm, 0.7).v, Vector3d::Zero());
}

TEST_F(CaseTest, GustsAndSeriesBlowTogether) {
  write("wind.csv", windRows(61, 0.02));
  const Case c = loadCase(write("gusts.yaml", plateIn(kGusts)), {}, CONFIG_DIR);
  const auto bump = [](double s) {
    return s > 0 && s < 1 ? 0.5 * (1 - std::cos(2 * M_PI * s)) : 0;
  };
  for (const double t : {0.0, 0.1, 0.3, 0.45, 0.6, 0.74, 0.9, 1.0}) {
    // North at 1 m/s: 0.25 m ahead and 0.5 m deep. The last gust lies above, out of reach.
    const Vector3d expected = Vector3d(0.3, 0.1, -0.2) + breeze(t) +
                              bump((t - 0.2) / 0.5) * Vector3d(0, 0.4, -1) +
                              bump((t - 0.25) / 0.5) * Vector3d(-0.5, 0, 0.3);
    EXPECT_LT((met(c, t).v - expected).norm(), 1e-6) << t;
    const Wind above = c.wind->at(t, {2, 0, -1}, {0, 0, 0}, {0, 0, 0});
    const Vector3d higher = Vector3d(0.3, 0.1, -0.2) + breeze(t) +
                            bump((t - 0.2) / 0.5) * Vector3d(0, 0.4, -1) + Vector3d(0, 0, 1);
    EXPECT_LT((above.v - higher).norm(), 1e-6) << t;  // in the middle of the layer from z = 0 up
  }
}

TEST_F(CaseTest, ResolvedWindsStandAloneBitForBit) {
  write("wind.csv", windRows(61, 0.02));
  for (const std::string& wind :
       {std::string(kGusts), std::string("{gusts: []}"), std::string("{steady: [0, 1, 0]}"),
        std::string("{gusts: [{kind: place, start: 0, length: 1, amplitude: [0, 0, 1]}]}")}) {
    const Case c = loadCase(write("gusts.yaml", plateIn(wind)), {}, CONFIG_DIR);
    fs::create_directories(folder_ / "elsewhere");
    const Case again = loadCase(write("elsewhere/resolved.yaml", c.resolved_yaml), {}, CONFIG_DIR);
    EXPECT_EQ(again.resolved_yaml, c.resolved_yaml);
    EXPECT_EQ(again.sha256, c.sha256);
    EXPECT_EQ(met(again, 0.41).v, met(c, 0.41).v);
    EXPECT_EQ(met(again, 0.41).a, met(c, 0.41).a);
  }
}

TEST_F(CaseTest, AllFaultsOfAWindAtOnce) {
  write("wind.csv", "t,wx,wy\n0,0,0\n");
  const std::string text = faults(write("bad.yaml", plateIn(R"({
    steady: [1, 2],
    gusts: [
      {kind: time, start: x, duration: 0, amplitude: 3},
      {kind: wave, start: 1},
      {kind: place, start: 1, length: -2, amplitude: [0, .nan, 0], direction: [0, 0, 0]},
      {kind: time, start: 0, start: 1, duration: 1, amplitude: [0, 0, 1], length: 2},
      7],
    file: wind.csv, extra: 1})")));
  for (const char* part :
       {"fluid/wind/steady has 2 values: must be 3",
        "fluid/wind/gusts[0]/start = 'x': must be a number in s",
        "fluid/wind/gusts[0]/duration = 0 s: must be > 0",
        "fluid/wind/gusts[0]/amplitude = '3': must be a list of numbers",
        "fluid/wind/gusts[1]/kind = 'wave': must be one of time, place",
        "fluid/wind/gusts[2]/length = -2 m: must be > 0", "fluid/wind/gusts[2]/amplitude[1]",
        "fluid/wind/gusts[2]/direction = [0, 0, 0]: must not be zero",
        "fluid/wind/gusts[3]/start is given twice (line ",
        "fluid/wind/gusts[3]/length is not a known key",
        "fluid/wind/gusts[4] = '7': must be a section of keys", "wind.csv: column 'wz' is missing",
        "fluid/wind/extra is not a known key"}) {
    expectHas(text, part);
  }
  expectHas(faults(write("list.yaml", plateIn("{gusts: {kind: time}}"))),
            "fluid/wind/gusts = a section: must be a list of sections");
  expectHas(faults(write("both.yaml", plateIn("{file: wind.csv, rows: [[0, 0, 0, 0]]}"))),
            "fluid/wind/file: give either file (a CSV) or rows");
  expectHas(faults(write("few.yaml", plateIn("{rows: [[0, 0, 0, 0], [1, 0, 0, 0]]}"))),
            "fluid/wind/rows: 2 rows: must be >= 6");
  write("wind.csv", windRows(41, 0.02));
  expectHas(faults(write("short.yaml", plateIn("{file: wind.csv}"))),
            "fluid/wind: the table reaches from 0 to 0.8 s: must cover the run from 0 to 1 s");
}

TEST_F(CaseTest, AGustAlongAFlightNeedsAFlight) {
  const std::string gust = "{gusts: [{kind: place, start: 0, length: 1, amplitude: [0, 0, 1]}]}";
  expectHas(faults(write("hover.yaml", plateIn(gust, "[0, 0, -1]"))),
            "fluid/wind/gusts[0]/direction = flight: the motion has no horizontal velocity");
  EXPECT_EQ(faults(write("flight.yaml", plateIn(gust, "[0, 0.1, -1]"))), "");
}

/// Only one wing of a butterfly is solved, and mirrored.
TEST_F(CaseTest, NoWindFromTheSideOnMirroredWings) {
  const auto climbIn = [this](const std::string& wind) {
    return faultsWith("climb_printed", "solver: navier_stokes",
                      "solver: quasi_steady\n  wind: " + wind);
  };
  const std::string why = "must be 0 while only one wing is solved and mirrored";
  expectHas(climbIn("[1, 0.2, 0]"), "fluid/wind[1] = 0.2 m/s: " + why);
  expectHas(climbIn("{steady: [1, 0.2, 0]}"), "fluid/wind/steady[1] = 0.2 m/s: " + why);
  expectHas(climbIn("{gusts: [{kind: time, start: 0, duration: 1, amplitude: [0, -3, 1]}]}"),
            "fluid/wind/gusts[0]/amplitude[1] = -3 m/s: " + why);
  fs::create_directories(folder_ / "cases");
  write("cases/wind.csv", windRows(61, 0.02));
  expectHas(climbIn("{file: wind.csv}"), "wind.csv: row 2, column wy = 0.0");
  EXPECT_EQ(climbIn("{steady: [1, 0, 0.4], gusts: [{kind: place, start: 0.1, length: 0.3, "
                    "amplitude: [0, 0, 1]}]}"),
            "");
}

/// A gust counts in the Courant number whenever and wherever it blows: one that is over between two
/// samples of the motion, and one that the prescribed motion never meets.
TEST_F(CaseTest, AGustIsInTheCourantEstimate) {
  const auto at = [this](const std::string& wind, const std::string& dt) {
    std::string text = plateIn(wind, "[1, 0, 0]");
    text.replace(text.find("dt: 0.02"), 8, "dt: " + dt);
    return write("courant.yaml", text);
  };
  const std::string brief =
      "{gusts: [{kind: time, start: 1e-4, duration: 1e-5, "
      "amplitude: [-1, 0, 0]}]}";
  const std::string away = "{gusts: [{kind: place, start: 70, length: 1, amplitude: [-1, 0, 0]}]}";
  const std::string astern =
      "{gusts: [{kind: time, start: 0.5, duration: 0.1, "
      "amplitude: [1, 0, 0]}]}";
  // 1 m/s and cells of 1/16 m: dt up to 0.1875 s; 2 m/s against the gusts: half of that.
  EXPECT_EQ(faults(at("[0, 0, 0]", "0.187")), "");
  EXPECT_EQ(faults(at("{gusts: []}", "0.187")), "");
  EXPECT_EQ(faults(at(astern, "0.187")), "");
  for (const std::string& gust : {brief, away}) {
    expectHas(faults(at(gust, "0.1")), "take dt <= 0.09375 s");
    const Case c = loadCase(at(gust, "0.09"), {}, CONFIG_DIR);
    EXPECT_NEAR(peakWingSpeeds(c).outline, 2.0, 1e-12);
    EXPECT_NEAR(referenceSpeed(c), 1.0, 1e-12);  // of what the motion meets
  }
}

class Keep : public StepSink {
 public:
  void onStep(const CommittedStep& step) override { steps.push_back(step); }
  void onReset() override {}
  void onEnd(const std::string&) override {}
  std::vector<CommittedStep> steps;
};

/// The wind is prescribed from the level before; it is that of the committed place to third order.
TEST_F(CaseTest, AFreeFlightMeetsTheGustThatStandsInItsWay) {
  const auto errorOf = [](int steps_per_flap) {
    const Case calm = loadCase("climb_trimmed",
                               {{"fluid", "quasi_steady"},
                                {"steps_per_flap", std::to_string(steps_per_flap)},
                                {"flaps", "1"}},
                               CONFIG_DIR);
    std::string text = calm.resolved_yaml;
    const std::string none = "wind: [0, 0, 0]";
    text.replace(text.find(none), none.size(),
                 "wind: {gusts: [{kind: place, start: 0.02, length: 0.1, amplitude: [0, 0, 1]}]}");
    const Case c = caseFromText(text, "gust", {}, CONFIG_DIR);
    Keep flight, still;
    EXPECT_TRUE(InProcessFederation(c).run(7, {&flight}, StopFlag(false)).complete);
    EXPECT_TRUE(InProcessFederation(calm).run(7, {&still}, StopFlag(false)).complete);
    double error = 0.0, strongest = 0.0;
    for (const CommittedStep& s : flight.steps) {
      const BodyState& body = s.interface.body;
      const Wind here = c.wind->at(s.t, body.x, body.v, body.a);
      error = std::max(error, (here.v - s.guided.wind.v).norm());
      strongest = std::max(strongest, here.v.norm());
    }
    EXPECT_GT(strongest, 0.9);
    EXPECT_GT((flight.steps.back().interface.body.x - still.steps.back().interface.body.x).norm(),
              0.003);
    return error;
  };
  const double coarse = errorOf(250), fine = errorOf(500);
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(std::log2(coarse / fine), 2.5);
}

}  // namespace
}  // namespace monarch_flight
