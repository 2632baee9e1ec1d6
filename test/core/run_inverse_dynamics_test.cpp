// Inverse dynamics of a flight: what is free needs nothing, and the hinge is found again.
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

class InverseDynamics : public CaseTest {
 protected:
  /// Flies a shipped case in quasi-steady air into the folder.
  Case fly(const std::string& name) {
    const Case c = loadCase(
        name, {{"fluid", "quasi_steady"}, {"flaps", "0.5"}, {"steps_per_flap", "200"}}, CONFIG_DIR);
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
};

TEST_F(InverseDynamics, AFreeFlightNeedsNothingAndItsHingeIsFound) {
  const Case c = fly("climb_printed");
  const auto rows = freeRows(c);
  ASSERT_GT(rows.size(), 80u);
  const double weight = c.insect.totalMass() * c.gravity;
  const Wing& hinge = c.insect.wings.right;
  for (const RequiredLoads& row : rows) {
    EXPECT_NEAR(row.force_x, 0.0, 1e-4 * weight);
    EXPECT_NEAR(row.force_z, 0.0, 1e-4 * weight);
    EXPECT_NEAR(row.pitch, 0.0, 1e-4 * weight * 0.01);
    EXPECT_NEAR(row.wing.y(), -hinge.kappa * (row.theta_R.q - hinge.theta_0), 1e-8);
  }
  const HingeFit fit = fitHinge(rows);
  EXPECT_NEAR(fit.kappa, hinge.kappa, 1e-3 * hinge.kappa);
  EXPECT_NEAR(fit.theta_0, hinge.theta_0, 1e-3);
  EXPECT_NEAR(fit.damping * 64.0, 0.0, 1e-3 * hinge.kappa);
  EXPECT_GT(fit.spring_share, 0.999);
}

TEST_F(InverseDynamics, APrescribedPitchNeedsAMoment) {
  const Case c = fly("passive_pitch");
  const auto rows = freeRows(c);
  double largest = 0.0;
  for (const RequiredLoads& row : rows) largest = std::max(largest, std::abs(row.pitch));
  EXPECT_GT(largest, 1e-5);  // the measured pitch is not that of a free body
  EXPECT_GT(fitHinge(rows).spring_share, 0.999);
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
