// Inverse dynamics of a flight: what is free needs nothing, and the hinge is found again.
#include <yaml-cpp/yaml.h>

#include <functional>

#include "case_fixture.h"
#include "monarch_flight/run/csv_tables.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/inverse_dynamics.h"

namespace monarch_flight {
namespace {

class TableSink : public StepSink {
 public:
  explicit TableSink(const std::string& path) : table_(path) {}
  void onStep(const CommittedStep& step) override { table_.append(step); }
  void onReset() override {}
  void onEnd(const std::string&) override { table_.file().finish(); }

 private:
  FlightTable table_;
};

using Edit = std::function<void(YAML::Node&)>;

class InverseDynamics : public CaseTest {
 protected:
  /// Flies a shipped case, with some of its keys changed, in quasi-steady air into the folder.
  Case fly(
      const std::string& name, const Edit& edit = [](YAML::Node&) {}) {
    const Case shipped = loadCase(
        name, {{"fluid", "quasi_steady"}, {"flaps", "0.5"}, {"steps_per_flap", "200"}}, CONFIG_DIR);
    YAML::Node root = YAML::Load(shipped.resolved_yaml);
    edit(root);
    const Case c = caseFromText(YAML::Dump(root), name, {}, CONFIG_DIR);
    std::ofstream(folder_ / "case.yaml") << c.resolved_yaml;
    TableSink sink((folder_ / "flight.csv").string());
    InProcessFederation federation(c);
    StopFlag stop{false};
    const RunResult result = federation.run(1, {&sink}, stop);
    EXPECT_TRUE(result.complete) << result.failure;
    return c;
  }
  std::vector<RequiredLoads> freeRows(const Case& c) {
    NumericTable table = readCsv((folder_ / "flight.csv").string());
    table.rows.erase(table.rows.begin(), table.rows.begin() + 1 + c.coupling.prescribed_steps);
    return requiredLoads(c, table);
  }
  std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string summary() const {
    std::ostringstream out;
    runInverseDynamics(folder_.string(), 0.25, -1.0, CONFIG_DIR, out);
    return out.str();
  }
};

/// Two wings that differ in area and spring, air from the side, a start in a bank.
void makeAsymmetric(YAML::Node& root) {
  root["wings"] = "independent";
  for (const char* key : {"y", "roll", "yaw"}) root["free"][key] = true;
  root["insect"]["left_wing"]["tip_lost"] = 0.2;
  root["insect"]["left_wing"]["kappa"] = 0.8 * root["insect"]["wing"]["kappa"].as<double>();
  root["insect"]["left_wing"]["theta_0"] = 0.1;
  root["fluid"]["wind"] = std::vector<double>{0.2, 1.0, -0.1};
  root["initial"]["roll"] = 0.2;
  root["initial"]["yaw_dot"] = -3.0;
}

void expectHinge(const std::vector<RequiredLoads>& rows, Side side, const Wing& hinge) {
  for (const RequiredLoads& row : rows) {
    const HingeLoad& wing = row.wings[side];
    EXPECT_NEAR(wing.torque.y(), -hinge.kappa * (wing.theta.q - hinge.theta_0), 1e-8);
  }
  const HingeFit fit = fitHinge(rows, side);
  EXPECT_NEAR(fit.kappa, hinge.kappa, 1e-3 * hinge.kappa);
  EXPECT_NEAR(fit.theta_0, hinge.theta_0, 1e-3);
  EXPECT_NEAR(fit.damping * 64.0, 0.0, 1e-3 * hinge.kappa);
  EXPECT_GT(fit.spring_share, 0.999);
}

TEST_F(InverseDynamics, AFreeFlightNeedsNothingAndItsHingeIsFound) {
  const Case c = fly("climb_printed");
  const auto rows = freeRows(c);
  ASSERT_GT(rows.size(), 80u);
  const double weight = c.insect.totalMass() * c.gravity;
  for (const RequiredLoads& row : rows) {
    EXPECT_NEAR(row.force.x(), 0.0, 1e-4 * weight);
    EXPECT_NEAR(row.force.z(), 0.0, 1e-4 * weight);
    EXPECT_NEAR(row.moment.y(), 0.0, 1e-4 * weight * 0.01);
  }
  expectHinge(rows, Side::kRight, c.insect.wings.right);
}

TEST_F(InverseDynamics, AFreeFlightOfTwoWingsNeedsNothingAndBothHingesAreFound) {
  const Case c = fly("climb_printed", makeAsymmetric);
  const auto rows = freeRows(c);
  ASSERT_GT(rows.size(), 80u);
  const double weight = c.insect.totalMass() * c.gravity;
  double force = 0.0, moment = 0.0;
  for (const RequiredLoads& row : rows) {
    force = std::max(force, row.force.lpNorm<Eigen::Infinity>());
    moment = std::max(moment, row.moment.lpNorm<Eigen::Infinity>());
  }
  EXPECT_LT(force, 1e-5 * weight);  // the tolerance of the coupling
  EXPECT_LT(moment, 1e-5 * weight * 0.01);
  for (Side side : kSides) expectHinge(rows, side, c.insect.wings[side]);
  const std::string text = summary();
  expectHas(text, "yaw moment");
  expectHas(text, "hinge torque of the right wing");
  expectHas(text, "hinge torque of the left wing");
}

/// Commands change the wingbeat: the table tells how.
TEST_F(InverseDynamics, AFlightThatIsLedNeedsNothingEither) {
  const Case c = fly("climb_controlled", [](YAML::Node& root) {
    root["fluid"]["wind"] = std::vector<double>{0.3, 0.0, -0.3};
    root["coupling"]["prescribed_steps"] = 10;
  });
  const auto rows = freeRows(c);
  ASSERT_GT(rows.size(), 80u);
  const double weight = c.insect.totalMass() * c.gravity;
  for (const RequiredLoads& row : rows) {
    EXPECT_LT(row.force.lpNorm<Eigen::Infinity>(), 1e-5 * weight);
    EXPECT_LT(row.moment.lpNorm<Eigen::Infinity>(), 1e-5 * weight * 0.01);
  }
  expectHinge(rows, Side::kRight, c.insect.wings.right);
  double largest = 0.0;
  for (double value : readCsv((folder_ / "flight.csv").string()).column("applied_amplitude"))
    largest = std::max(largest, std::abs(value));
  EXPECT_GT(largest, 0.01);  // it was led
}

TEST(HingeFit, TakesTheShiftOfTheRestAngle) {
  std::vector<RequiredLoads> rows(20);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double t = 0.1 * static_cast<double>(i);
    HingeLoad& hinge = rows[i].wings.left;
    hinge.theta = {std::sin(3.0 * t), 3.0 * std::cos(3.0 * t), 0.0};
    hinge.rest_angle = 0.2 * t;
    hinge.torque.y() = -2.0 * (hinge.theta.q - hinge.rest_angle - 0.1) - 0.3 * hinge.theta.qd;
  }
  const HingeFit fit = fitHinge(rows, Side::kLeft);
  EXPECT_NEAR(fit.kappa, 2.0, 1e-12);
  EXPECT_NEAR(fit.theta_0, 0.1, 1e-12);
  EXPECT_NEAR(fit.damping, 0.3, 1e-12);
  EXPECT_THROW(fitHinge(rows, Side::kRight), InputError);  // it does not pitch
}

TEST_F(InverseDynamics, ACoordinateThatIsNotFreeIsHeld) {
  const Case c = fly("climb_printed", [](YAML::Node& root) {
    makeAsymmetric(root);
    for (const char* key : {"y", "roll", "yaw"}) root["free"][key] = false;
    root["initial"].remove("roll");
    root["initial"].remove("yaw_dot");
  });
  const double weight = c.insect.totalMass() * c.gravity;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  for (const RequiredLoads& row : freeRows(c)) {
    force = force.cwiseMax(row.force.cwiseAbs());
    moment = moment.cwiseMax(row.moment.cwiseAbs());
  }
  EXPECT_LT(force.x(), 1e-4 * weight);
  EXPECT_LT(force.z(), 1e-4 * weight);
  EXPECT_LT(moment.y(), 1e-4 * weight * 0.01);
  EXPECT_GT(force.y(), 0.01 * weight);  // one wing is smaller, and the air comes from the side
  EXPECT_GT(moment.x(), 0.01 * weight * 0.01);
  EXPECT_GT(moment.z(), 0.01 * weight * 0.01);
}

TEST_F(InverseDynamics, MirroredWingsAndTwoThatDoTheSameNeedTheSame) {
  fly("passive_pitch");
  const std::string one = summary(), one_table = read("inverse_dynamics.csv");
  fly("passive_pitch", [](YAML::Node& root) { root["wings"] = "independent"; });
  const std::string two = summary(), two_table = read("inverse_dynamics.csv");
  EXPECT_EQ(one_table, two_table);
  const auto hinge = [](const std::string& text, const char* from) {
    const std::size_t at = text.find("\n", text.find(from));
    return text.substr(at, text.find("the case has", at) - at);
  };
  EXPECT_EQ(hinge(one, "of one wing"), hinge(two, "of the right wing"));
  EXPECT_EQ(hinge(one, "of one wing"), hinge(two, "of the left wing"));
  const NumericTable table = readCsv((folder_ / "inverse_dynamics.csv").string());
  EXPECT_EQ(table.column("wing_x"), table.column("wing_x_L"));
  EXPECT_EQ(table.column("wing_y"), table.column("wing_y_L"));
  EXPECT_EQ(table.column("wing_z"), table.column("wing_z_L"));
  for (const char* name : {"force_y", "roll", "yaw"}) {
    for (double value : table.column(name)) EXPECT_NEAR(value, 0.0, 1e-15) << name;
  }
}

TEST_F(InverseDynamics, APrescribedPitchNeedsAMoment) {
  const Case c = fly("passive_pitch");
  const auto rows = freeRows(c);
  double largest = 0.0;
  for (const RequiredLoads& row : rows) largest = std::max(largest, std::abs(row.moment.y()));
  EXPECT_GT(largest, 1e-5);  // the measured pitch is not that of a free body
  EXPECT_GT(fitHinge(rows, Side::kRight).spring_share, 0.999);
}

TEST_F(InverseDynamics, WritesItsTableAndNamesWhatIsMissing) {
  fly("passive_pitch");
  std::ostringstream out;
  runInverseDynamics(folder_.string(), 0.25, -1.0, CONFIG_DIR, out);
  expectHas(out.str(), "nearest spring");
  EXPECT_EQ(readCsv((folder_ / "inverse_dynamics.csv").string()).rows.size(), 51u);
  EXPECT_THROW(runInverseDynamics(folder_.string(), 3.0, -1.0, CONFIG_DIR, out), InputError);
  EXPECT_THROW(runInverseDynamics((folder_ / "none").string(), 0.0, -1.0, CONFIG_DIR, out),
               InputError);
}

}  // namespace
}  // namespace monarch_flight
