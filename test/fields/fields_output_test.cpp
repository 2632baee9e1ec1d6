// Files of the flow, read back by VTK's own readers against what the solver has.
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLStructuredGridReader.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "monarch_flight/fields/field_output.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/checkpoints.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/pressure_reference.h"
#include "monarch_flight/run/run_outputs.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

const Vector3d kWind(0.3, -0.2, 0.1);  // NED [m/s]

/// Keeps the steps that carry a flow.
class Keeper : public StepSink {
 public:
  void onStep(const CommittedStep& step) override {
    if (step.flow.right) steps.push_back(step);
  }
  void onReset() override { steps.clear(); }
  void onEnd(const std::string&) override {}
  std::vector<CommittedStep> steps;
};

Vector3d world(const Vector3d& ned) { return {ned.y(), ned.x(), -ned.z()}; }

Vector3d tuple(vtkDataArray* a, vtkIdType i) { return Vector3d(a->GetTuple3(i)); }

/// Ends the run behind a step as a full disk does; the solvers' last checkpoint is older.
class FullDisk : public Keeper {
 public:
  explicit FullDisk(std::uint32_t at) : at_(at) {}
  void onStep(const CommittedStep& step) override {
    if (step.step == at_) throw OutputError("the disk is full");
  }

 private:
  std::uint32_t at_;
};

/// One flight for all tests: a monarch in wind, two files in four steps.
class Fields : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() =
        (fs::temp_directory_path() / ("monarch_fields_" + std::to_string(getpid()))).string();
    Case& c = theCase();
    c = loadCase(
        "tethered_fwuav",
        {{"flaps", "0.02"}, {"steps_per_flap", "200"}, {"record", "false"}, {"fields_every", "2"}},
        CONFIG_DIR);
    c.grid.cells_per_chord = 6;
    c.grid.far_field = 3;
    c.wind = std::make_shared<SteadyWind>(kWind);
    InProcessFederation federation(c);
    const auto files = makeFieldOutput(c, folder());
    const RunResult result = federation.run(1, {&keeper(), files.get()}, StopFlag(false));
    ASSERT_TRUE(result.complete) << result.failure;
    ASSERT_EQ(2u, keeper().steps.size());
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }

  /// Flies into folder()/name, files of every so many steps, to the step where the disk fills.
  static void fly(const std::string& name, int every, bool resume, std::uint32_t until) {
    Case c = theCase();
    c.time.steps = 8;
    c.output.fields_every = every;
    c.output.checkpoint_every = 3;
    const std::string out = folder() + "/" + name;
    Checkpoints checkpoints(c, out, resume, 1);
    const auto fields = makeFieldOutput(c, out + "/fields", checkpoints.outputs());
    RunOutputs files(c, out, &checkpoints);
    FullDisk disk(until);
    InProcessFederation federation(c, checkpointFolder(out));
    const RunResult result =
        federation.run(1, {fields.get(), &files, &disk}, StopFlag(false), &checkpoints);
    EXPECT_EQ(until > 8, result.complete) << result.failure;
  }
  /// Name and bytes of every file.
  static std::map<std::string, std::string> files(const std::string& name) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::directory_iterator(folder() + "/" + name + "/fields")) {
      std::ifstream file(entry.path(), std::ios::binary);
      std::stringstream bytes;
      bytes << file.rdbuf();
      found[entry.path().filename()] = bytes.str();
    }
    return found;
  }

  static std::string& folder() {
    static std::string f;
    return f;
  }
  static Case& theCase() {
    static Case c;
    return c;
  }
  static Keeper& keeper() {
    static Keeper k;
    return k;
  }
  static const CommittedStep& last() { return keeper().steps.back(); }
  static WingMotion motion() {
    return wingMotion(Side::kRight, theCase().insect, last().interface.body, last().angles);
  }

  static vtkSmartPointer<vtkStructuredGrid> grid() {
    vtkNew<vtkXMLStructuredGridReader> reader;
    reader->SetFileName((folder() + "/flow_00000004.vts").c_str());
    reader->Update();
    return reader->GetOutput();
  }
  static vtkSmartPointer<vtkPolyData> wings() {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder() + "/wing_00000004.vtp").c_str());
    reader->Update();
    return reader->GetOutput();
  }
};

TEST_F(Fields, TheGridStandsInTheWorld) {
  const auto g = grid();
  const FlowField& flow = *last().flow.right;
  int n[3];
  g->GetDimensions(n);
  EXPECT_EQ(static_cast<int>(flow.x.size()), n[0]);
  EXPECT_EQ(static_cast<int>(flow.y.size()), n[1]);
  EXPECT_EQ(static_cast<int>(flow.z.size()), n[2]);
  const WingMotion m = motion();
  for (const auto& [i, j, k] : {std::array<int, 3>{0, 0, 0}, {5, 7, 3}, {n[0] - 1, 0, n[2] - 1}}) {
    const Vector3d r(flow.x[i], flow.y[j], flow.z[k]);
    const Vector3d expected = world(m.r_I + m.R_IW * r);
    const Vector3d point(g->GetPoint((static_cast<vtkIdType>(k) * n[1] + j) * n[0] + i));
    EXPECT_LT((point - expected).norm(), 1e-14);
  }
  EXPECT_EQ(last().t, g->GetFieldData()->GetArray("TimeValue")->GetTuple1(0));
}

TEST_F(Fields, TheValuesAreTheSolversTurnedIntoTheWorld) {
  const auto g = grid();
  const FlowField& flow = *last().flow.right;
  ASSERT_EQ(static_cast<vtkIdType>(flow.cells()), g->GetNumberOfCells());
  const Eigen::Matrix3d R = motion().R_IW;
  vtkCellData* data = g->GetCellData();
  double fastest = 0;
  for (vtkIdType i = 0; i < g->GetNumberOfCells(); ++i) {
    EXPECT_EQ(flow.pressure[i], float(data->GetArray("pressure")->GetTuple1(i)));
    EXPECT_EQ(flow.q[i], float(data->GetArray("Q")->GetTuple1(i)));
    const Vector3d v = Eigen::Map<const Eigen::Vector3f>(&flow.velocity[3 * i]).cast<double>();
    const Vector3d w = Eigen::Map<const Eigen::Vector3f>(&flow.vorticity[3 * i]).cast<double>();
    fastest = std::max(fastest, v.norm());
    const Vector3d expected = world(R * v + kWind);
    EXPECT_LT((tuple(data->GetArray("velocity"), i) - expected).norm(), 1e-6);
    EXPECT_LT((tuple(data->GetArray("vorticity"), i) - world(R * w)).norm(), 1e-6 * (1 + w.norm()));
    EXPECT_EQ(flow.vorticity[3 * i + 1], float(data->GetArray("spanwise_vorticity")->GetTuple1(i)));
  }
  EXPECT_GT(fastest, 0.5);  // the wing has moved the air
}

TEST_F(Fields, TheWingsCarryTheLoads) {
  const auto s = wings();
  const vtkIdType faces = static_cast<vtkIdType>(last().flow.right->wing.size());
  ASSERT_EQ(2 * faces, s->GetNumberOfCells());
  vtkCellData* data = s->GetCellData();
  Vector3d pressure = Vector3d::Zero(), friction = Vector3d::Zero(), left = Vector3d::Zero();
  for (vtkIdType i = 0; i < 2 * faces; ++i) {
    vtkPoints* p = s->GetCell(i)->GetPoints();
    const Vector3d a(p->GetPoint(0)), b(p->GetPoint(1)), d(p->GetPoint(3));
    const double area = (b - a).cross(d - a).norm();
    const Vector3d push =
        area * data->GetArray("pressure_jump")->GetTuple1(i) * tuple(data->GetArray("normal"), i);
    if (i >= faces) {
      left += push;
      continue;
    }
    pressure += push;
    friction += area * (tuple(data->GetArray("friction_dorsal"), i) +
                        tuple(data->GetArray("friction_ventral"), i));
  }
  const Eigen::Matrix3d R = motion().R_IW;
  const Vector3d expected = world(R * last().loads.right.force_pressure);
  EXPECT_LT((pressure - expected).norm(), 1e-5 * expected.norm());
  EXPECT_LT((left - Vector3d(-expected.x(), expected.y(), expected.z())).norm(),
            1e-5 * expected.norm());  // mirrored: the body's plane of symmetry is east = 0
  // The part along the wing's normal acts at the rim and is not of the faces.
  const Vector3d rubbed = last().loads.right.force_friction, along(rubbed.x(), rubbed.y(), 0);
  EXPECT_LT((friction - world(R * along)).norm(), 1e-5 * along.norm());
}

TEST_F(Fields, CpIsPressureOverTheDynamicOne) {
  const auto s = wings();
  const double dynamic = pressureReference(theCase()).dynamic;
  for (const char* side : {"dorsal", "ventral", "jump"}) {
    vtkDataArray* p = s->GetCellData()->GetArray((std::string("pressure_") + side).c_str());
    vtkDataArray* cp = s->GetCellData()->GetArray((std::string("Cp_") + side).c_str());
    EXPECT_NEAR(cp->GetTuple1(7), p->GetTuple1(7) / dynamic, 1e-6 * std::abs(cp->GetTuple1(7)));
  }
}

TEST_F(Fields, TheSeriesNamesEveryFileWithItsTime) {
  std::ifstream file(folder() + "/fields.pvd");
  std::stringstream text;
  text << file.rdbuf();
  std::vector<std::string> found;
  const std::string all = text.str();
  for (const char* name :
       {"flow_00000002.vts", "wing_00000002.vtp", "flow_00000004.vts", "wing_00000004.vtp"}) {
    EXPECT_NE(std::string::npos, all.find(name)) << all;
    EXPECT_TRUE(fs::exists(folder() + "/" + name));
  }
  char time[64];
  std::snprintf(time, sizeof time, "timestep=\"%.17g\"", last().t);
  EXPECT_NE(std::string::npos, all.find(time)) << all;
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder())) files += entry.is_regular_file();
  EXPECT_EQ(5, files);  // nothing half-written is left
}

TEST_F(Fields, AResetTakesTheFilesBack) {
  const std::string other = folder() + "/other";
  const auto files = makeFieldOutput(theCase(), other);
  files->onStep(last());
  EXPECT_TRUE(fs::exists(other + "/flow_00000004.vts"));
  files->onReset();
  EXPECT_TRUE(fs::is_empty(other));
}

TEST_F(Fields, AFolderThatCannotBeMadeEndsTheRun) {
  const auto files = makeFieldOutput(theCase(), "/proc/fields");
  EXPECT_THROW(files->onStep(last()), std::runtime_error);
}

// The file of step 4 lies behind the checkpoint of step 3: written twice, or not any more.
TEST_F(Fields, ARunThatGoesOnHasNeitherGapNorDouble) {
  fly("whole", 2, false, 9);
  fly("cut", 2, false, 5);
  ASSERT_EQ(5u, files("cut").size());
  fly("cut", 2, true, 9);
  ASSERT_EQ(9u, files("whole").size());
  EXPECT_TRUE(files("whole") == files("cut"));

  fly("other", 2, false, 5);
  fly("other", 3, true, 9);
  const auto found = files("other");
  EXPECT_EQ(5u, found.size());
  for (const char* step : {"00000002", "00000006"}) {
    EXPECT_EQ(1u, found.count("flow_" + std::string(step) + ".vts"));
    EXPECT_EQ(1u, found.count("wing_" + std::string(step) + ".vtp"));
  }
  EXPECT_EQ(std::string::npos, found.at("fields.pvd").find("00000004"));
}

}  // namespace
}  // namespace monarch_flight
