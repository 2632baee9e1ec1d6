// Files of a run: tables, summary, hash, folder, progress line, and what happens when a disk
// refuses.
#include "monarch_flight/run/run_outputs.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"
#include "monarch_flight/run/progress.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;
constexpr double kPi = 3.14159265358979323846;

// A new folder for each test, gone afterwards.
class RunFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "monarch_run_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    base_ = name;
  }
  void TearDown() override { fs::remove_all(base_); }

  std::string out() const { return (base_ / "out").string(); }
  std::string read(const std::string& name) const {
    std::ifstream file(out() + "/" + name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  bool exists(const std::string& name) const { return fs::exists(out() + "/" + name); }

  fs::path base_;
};

Case smallCase() {
  Case c;
  c.name = "small";
  c.time = {0.1, 0.0, 0.01, 25};
  c.resolved_yaml = "name: small\n";
  c.sha256 = "0123abcd";
  c.output.record = false;
  return c;
}

// Flight at (2, 0, -1) m/s with numbers that differ in every column.
CommittedStep stepAt(std::uint32_t n) {
  CommittedStep s;
  s.step = n;
  s.t = 0.01 * n;
  BodyState& body = s.interface.body;
  body.x = Eigen::Vector3d(2.0, 0.0, -1.0) * s.t;
  body.v = Eigen::Vector3d(2.0, 0.0, -1.0);
  body.a = Eigen::Vector3d(0.1, 0.2, 0.3);
  body = withPitch(body, {0.1 + 0.01 * n, 1.0, 100.0});
  s.interface.theta_R = {-0.2 + 0.02 * n, 2.0, 200.0};
  s.angles.phi.q = 0.4;
  s.angles.psi.q = 0.5;
  s.angles.theta = s.interface.theta_R;
  s.angles.theta_A.q = 0.6;
  s.loads.force_pressure = Eigen::Vector3d(1, 2, 3);
  s.loads.force_friction = Eigen::Vector3d(0.25, 0.5, 0.75);
  s.loads.moment_pressure = Eigen::Vector3d(4, 5, 6);
  s.loads.moment_friction = Eigen::Vector3d(0.125, 0.25, 0.375);
  s.force_I = Eigen::Vector3d(7, 8, 9);
  s.fluid.courant = 0.875;
  s.wall_s = {0.5, 0.25, 0.125};
  s.exchange_s = 0.0625;
  s.coupling_s = 0.03125;
  s.outputs_s = 0.5 * n;
  for (std::size_t k = 0; k < kKernels; ++k) s.fluid.kernel_s[k] = 0.03125 * n * (k + 1.0) / 45;
  s.fluid_evaluations = n < 25 ? 10 : 33;
  s.added_mass_ratio = n == 25 ? 2.125 : 1.125;
  s.work_fluid = -0.25;
  s.work_structure = n == 25 ? -0.5 : -0.375;
  s.prescribed = n <= 2;
  if (n == 0) {
    s.fluid.cells = 42;
    s.fluid.added_mass = 3.0 * Matrix6d::Identity();
    return s;
  }
  for (std::uint32_t k = 0; k < (n <= 2 ? 1 : 3 + n % 2); ++k)
    s.iterations.push_back({n, k, k > 2 ? 2u : 1u, {1e-3, 2e-3, 3e-3, 4e-3}, 5e-3, 0.5, 0.7});
  return s;
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::vector<double> numbers(const std::string& row) {
  std::istringstream stream(row);
  std::vector<double> result;
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(std::stod(cell));
  return result;
}

TEST_F(RunFiles, FlightTableHasTheNamedColumnsAndEveryBit) {
  RunOutputs outputs(smallCase(), out());
  const CommittedStep step = stepAt(3);
  outputs.onStep(stepAt(0));
  outputs.onStep(step);
  EXPECT_TRUE(exists("flight.csv.active"));
  EXPECT_FALSE(exists("flight.csv"));
  outputs.onEnd("");
  EXPECT_FALSE(exists("flight.csv.active"));
  const auto rows = lines(read("flight.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(
      rows[0],
      "t,x,y,z,vx,vy,vz,ax,ay,az,theta_B,theta_B_dot,theta_B_ddot,qw,qx,qy,qz,phi,psi,theta_R,"
      "theta_R_dot,theta_R_ddot,theta_A,fx,fy,fz,mx,my,mz,fx_p,fy_p,fz_p,mx_p,my_p,mz_p,FX,FY,"
      "FZ,sub_iterations,courant");
  const double b = step.interface.body.pitch.q, r = step.interface.theta_R.q;
  const std::vector<double> expected = {step.t, step.interface.body.x[0],
                                        0,      step.interface.body.x[2],
                                        2,      0,
                                        -1,     0.1,
                                        0.2,    0.3,
                                        b,      1,
                                        100,    std::cos(0.5 * b),
                                        0,      std::sin(0.5 * b),
                                        0,      0.4,
                                        0.5,    r,
                                        2,      200,
                                        0.6,    1.25,
                                        2.5,    3.75,
                                        4.125,  5.25,
                                        6.375,  1,
                                        2,      3,
                                        4,      5,
                                        6,      7,
                                        8,      9,
                                        4,      0.875};
  const auto row = numbers(rows[2]);
  ASSERT_EQ(row.size(), expected.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool quaternion = i >= 13 && i < 17;
    EXPECT_NEAR(row[i], expected[i], quaternion ? 1e-15 : 0.0) << "column " << i;
  }
}

TEST_F(RunFiles, QuaternionDoesNotJumpThroughAFullTurn) {
  RunOutputs outputs(smallCase(), out());
  for (std::uint32_t n = 0; n <= 36; ++n) {
    CommittedStep s = stepAt(n);
    s.interface.body = withPitch(s.interface.body, {n * 20.0 * kPi / 180.0, 0, 0});
    outputs.onStep(s);
  }
  outputs.onEnd("");
  const auto rows = lines(read("flight.csv"));
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const auto before = numbers(rows[i - 1]), now = numbers(rows[i]);
    double dot = 0.0;
    for (int k = 13; k < 17; ++k) dot += before[k] * now[k];
    EXPECT_NEAR(dot, std::cos(10.0 * kPi / 180.0), 1e-12);
  }
}

TEST_F(RunFiles, IterationTableHasARowPerSubIteration) {
  RunOutputs outputs(smallCase(), out());
  for (std::uint32_t n = 0; n <= 3; ++n) outputs.onStep(stepAt(n));
  outputs.onEnd("");
  const auto rows = lines(read("iterations.csv"));
  ASSERT_EQ(rows.size(), 1u + 0u + 1u + 1u + 4u);
  EXPECT_EQ(
      rows[0],
      "step,iteration,t,residual_x,residual_z,residual_theta_B,residual_theta_R,load_residual,"
      "relaxation,fluid_wall_s,attempt");
  EXPECT_EQ(numbers(rows[6]),
            (std::vector<double>{3, 3, stepAt(3).t, 1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 0.5, 0.7, 2}));
}

TEST_F(RunFiles, SummaryHasEveryKeyAndTheRightNumbers) {
  RunOutputs outputs(smallCase(), out());
  for (std::uint32_t n = 0; n <= 25; ++n) {
    CommittedStep s = stepAt(n);
    if (n > 20) s.interface.body.x += Eigen::Vector3d(100, 0, 0);  // after the last whole flap
    outputs.onStep(s);
  }
  outputs.onEnd("");
  const auto j = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(j.at("status"), "complete");
  EXPECT_EQ(j.at("failure"), "");
  EXPECT_EQ(j.at("case"), "small");
  EXPECT_EQ(j.at("case_sha256"), "0123abcd");
  EXPECT_FALSE(j.at("version").get<std::string>().empty());
  EXPECT_EQ(j.at("steps"), 25);
  EXPECT_NEAR(j.at("flaps").get<double>(), 2.5, 1e-12);
  // steps 3 .. 25 were solved: 12 odd ones with 4, 11 even ones with 3 sub-iterations
  EXPECT_NEAR(j.at("sub_iterations").at("mean").get<double>(), (12 * 4 + 11 * 3) / 23.0, 1e-12);
  EXPECT_EQ(j.at("sub_iterations").at("max"), 4);
  EXPECT_EQ(j.at("retried_steps"), 12);
  EXPECT_NEAR(j.at("fluid_evaluations").at("mean").get<double>(), (22 * 10 + 33) / 23.0, 1e-12);
  EXPECT_EQ(j.at("fluid_evaluations").at("max"), 33);
  EXPECT_NEAR(j.at("added_mass_ratio").at("mean").get<double>(), 1.125 + 1.0 / 25.0, 1e-12);
  EXPECT_EQ(j.at("added_mass_ratio").at("max"), 2.125);
  EXPECT_EQ(j.at("air_work_J").at("fluid"), -0.25 * 23);
  EXPECT_EQ(j.at("air_work_J").at("structure"), -0.375 * 22 - 0.5);
  EXPECT_EQ(j.at("air_work_J").at("largest_error_of_a_step"), 0.25);
  EXPECT_EQ(j.at("air_work_J").at("largest_step"), 0.25);
  EXPECT_NEAR(j.at("climb_angle_deg").get<double>(), std::atan2(1.0, 2.0) * 180 / kPi, 1e-9);
  EXPECT_NEAR(j.at("speed_m_s").get<double>(), std::sqrt(5.0), 1e-12);
  const double degree = 180.0 / kPi;
  EXPECT_NEAR(j.at("theta_B_deg").at("min").get<double>(), 0.1 * degree, 1e-12);
  EXPECT_NEAR(j.at("theta_B_deg").at("mean").get<double>(), 0.225 * degree, 1e-9);
  EXPECT_NEAR(j.at("theta_B_deg").at("max").get<double>(), 0.35 * degree, 1e-9);
  EXPECT_NEAR(j.at("theta_R_deg").at("min").get<double>(), -0.2 * degree, 1e-12);
  EXPECT_NEAR(j.at("theta_R_deg").at("max").get<double>(), 0.3 * degree, 1e-9);
  EXPECT_EQ(j.at("wall_s").at("fluid"), 13.0);
  EXPECT_EQ(j.at("wall_s").at("flight"), 6.5);
  EXPECT_EQ(j.at("wall_s").at("wing"), 3.25);
  EXPECT_EQ(j.at("wall_s").at("exchange"), 1.625);
  EXPECT_EQ(j.at("wall_s").at("coupling"), 0.8125);
  EXPECT_EQ(j.at("wall_s").at("outputs"), 12.5);
  const nlohmann::json& kernels = j.at("fluid_s");
  EXPECT_EQ(kernels.size(), kKernels + 1);
  EXPECT_NEAR(kernels.at("turning").get<double>(), 25 * 0.03125 / 45, 1e-15);
  EXPECT_NEAR(kernels.at("projection").get<double>(), 25 * 0.03125 * 9 / 45, 1e-15);
  EXPECT_NEAR(kernels.at("rest").get<double>(), 13.0 - 25 * 0.03125, 1e-12);
  EXPECT_GE(j.at("wall_s").at("total").get<double>(), 0.0);
  EXPECT_EQ(j.at("cells"), 42);
  ASSERT_EQ(j.at("added_mass").size(), 6u);
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) EXPECT_EQ(j.at("added_mass").at(i).at(k), i == k ? 3.0 : 0.0);
  EXPECT_EQ(j.at("state_sha256").get<std::string>().size(), 64u);
  EXPECT_EQ(read("case.yaml"), "name: small\n");
}

TEST_F(RunFiles, FailedRunSaysSoAndKeepsItsTables) {
  RunOutputs outputs(smallCase(), out());
  outputs.onStep(stepAt(0));
  outputs.onStep(stepAt(1));
  outputs.onEnd("wing: no answer in step 2");
  const auto j = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(j.at("status"), "failed");
  EXPECT_EQ(j.at("failure"), "wing: no answer in step 2");
  EXPECT_EQ(lines(read("flight.csv")).size(), 3u);
}

TEST(StateHashTest, IsSha256OfTheStatedLayout) {
  StateHash empty;  // SHA-256 of nothing
  EXPECT_EQ(empty.hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CommittedStep zero;  // 43 doubles of which only R_IB = identity is not 0
  StateHash hash;
  hash.add(zero);
  // python3 -c "import hashlib, struct; a = [0.0] * 43;
  //     a[10] = a[14] = a[18] = 1.0; print(hashlib.sha256(struct.pack('<43d', *a)).hexdigest())"
  EXPECT_EQ(hash.hex(), "33210e8c9751d2049822a5297db457238dd783269d0d71f5c61fa0bbc4389767");
}

TEST(StateHashTest, SeesEveryStateAndNothingElse) {
  const auto hashOf = [](const CommittedStep& s) {
    StateHash hash;
    hash.add(stepAt(0));
    hash.add(s);
    return hash.hex();
  };
  const std::string reference = hashOf(stepAt(1));
  EXPECT_EQ(hashOf(stepAt(1)), reference);
  CommittedStep s = stepAt(1);
  s.wall_s[0] = 99.0;
  s.iterations.clear();
  EXPECT_EQ(hashOf(s), reference);
  const auto changed = [&](auto change) {
    CommittedStep other = stepAt(1);
    change(other);
    return hashOf(other) != reference;
  };
  const auto bump = [](double& v) { v = std::nextafter(v, 1e9); };
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.t); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.x.y()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.a.z()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.R_IB(2, 0)); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.Omega_dot_B.y()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.body.pitch.qd); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.interface.theta_R.qdd); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.loads.force_friction.x()); }));
  EXPECT_TRUE(changed([&](CommittedStep& o) { bump(o.loads.moment_pressure.z()); }));
}

template <class Action>
std::string messageOf(Action action) {
  try {
    action();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST_F(RunFiles, ExistingFlightIsNotOverwritten) {
  fs::create_directories(out());
  std::ofstream(out() + "/flight.csv") << "an earlier flight\n";
  EXPECT_THROW(RunOutputs(smallCase(), out()), InputError);
  const std::string message = messageOf([&] { RunDirectory(out(), 0); });
  EXPECT_NE(message.find(out()), std::string::npos);
  EXPECT_NE(message.find("empty folder"), std::string::npos);
  EXPECT_EQ(read("flight.csv"), "an earlier flight\n");
  EXPECT_FALSE(exists("case.yaml"));
  fs::remove(out() + "/flight.csv");
  EXPECT_NO_THROW(RunDirectory(out(), 0));  // an empty folder is welcome
}

TEST_F(RunFiles, FileInPlaceOfAFolderIsRefused) {
  std::ofstream(out()) << "text";
  EXPECT_NE(messageOf([&] { RunDirectory(out(), 0); }).find("must be a folder"), std::string::npos);
  EXPECT_NE(messageOf([&] { RunDirectory(out() + "/below", 0); }).find("cannot be created"),
            std::string::npos);
}

TEST_F(RunFiles, TooSmallADiskIsRefusedBeforehand) {
  const std::string message = messageOf([&] { RunDirectory(out(), std::uint64_t{1} << 62); });
  EXPECT_NE(message.find("MB left"), std::string::npos);
  EXPECT_NE(message.find("free space"), std::string::npos);
  EXPECT_THROW(RunDirectory(out(), std::uint64_t{1} << 62), InputError);
}

TEST(EstimatedOutput, GrowsWithStepsAndWithTheBag) {
  Case c = smallCase();
  c.output.checkpoint_every = 0;  // their size does not depend on the steps
  const auto small = estimatedOutputBytes(c);
  c.output.record = true;
  const auto recorded = estimatedOutputBytes(c);
  c.time.steps *= 10;
  EXPECT_GT(recorded, small);
  EXPECT_GT(estimatedOutputBytes(c), 5 * recorded / 2);
}

// The system refuses to let any file grow beyond this many bytes while an object of this class
// lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_;
  sighandler_t handler_;
};

TEST_F(RunFiles, RefusedWriteEndsTheRunAndLeavesTheTableUnderItsActiveName) {
  RunOutputs outputs(smallCase(), out());
  outputs.onStep(stepAt(0));
  std::string failure;
  {
    const FileSizeLimit limit(3000);
    for (std::uint32_t n = 1; n <= 25 && failure.empty(); ++n) {
      CommittedStep step = stepAt(n);
      step.iterations.resize(1);  // flight.csv is the first file to reach the limit
      failure = messageOf([&] { outputs.onStep(step); });
    }
  }
  EXPECT_NE(failure.find("flight.csv.active cannot be written"), std::string::npos) << failure;
  EXPECT_NE(failure.find("out:="), std::string::npos);
  const std::string end = messageOf([&] { outputs.onEnd(failure); });
  EXPECT_TRUE(end.empty()) << "the failure is known already: " << end;
  EXPECT_TRUE(exists("flight.csv.active"));
  EXPECT_FALSE(exists("flight.csv"));
  EXPECT_TRUE(exists("iterations.csv"));
  const auto j = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(j.at("status"), "failed");
  EXPECT_EQ(j.at("failure"), failure);
}

TEST_F(RunFiles, RefusedSummaryIsAFailureOfItsOwn) {
  RunOutputs outputs(smallCase(), out());
  outputs.onStep(stepAt(0));
  std::string end;
  {
    const FileSizeLimit limit(100);
    end = messageOf([&] { outputs.onEnd(""); });
  }
  EXPECT_NE(end.find("summary.json.active cannot be written"), std::string::npos) << end;
  EXPECT_FALSE(exists("summary.json"));
  EXPECT_TRUE(exists("flight.csv"));
}

TEST(OutputFileTest, FullDeviceIsNamedWithReasonAndRemedy) {
  const std::string folder =
      fs::temp_directory_path() / ("monarch_full_" + std::to_string(getpid()));
  fs::create_directories(folder);
  fs::create_symlink("/dev/full", folder + "/table.active");
  std::string message;
  {
    OutputFile file(folder + "/table");
    message = messageOf([&] { file.write("x"); });
    EXPECT_TRUE(file.failed());
    EXPECT_EQ(messageOf([&] { file.finish(); }), message);
  }
  fs::remove_all(folder);
  EXPECT_NE(message.find("table.active cannot be written (No space left on device): free space"),
            std::string::npos)
      << message;
}

TEST(Progress, PlainLineAfterEveryTenth) {
  std::ostringstream stream;
  ProgressSink sink(stream, false, {0.1, 0.0, 0.01, 25});
  for (std::uint32_t n = 0; n <= 25; ++n) sink.onStep(stepAt(n));
  sink.onEnd("");
  const auto text = lines(stream.str());
  ASSERT_EQ(text.size(), 10u);
  EXPECT_EQ(text[0].substr(0, 70),
            "[###.................]  12 %  flap 0.30/2.5  step 3/25  sub-iterations");
  EXPECT_NE(text[9].find("100 %  flap 2.50/2.5  step 25/25  sub-iterations 4  left 0:00"),
            std::string::npos);
  EXPECT_EQ(stream.str().find('\r'), std::string::npos);
}

TEST(Progress, RedrawsOneLineOnATerminal) {
  std::ostringstream stream;
  ProgressSink sink(stream, true, {0.0, 0.0, 0.01, 25});
  for (std::uint32_t n = 0; n <= 25; ++n) sink.onStep(stepAt(n));
  sink.onEnd("");
  const auto text = stream.str();
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_EQ(text.front(), '\r');
  EXPECT_NE(text.find("step 25/25"), std::string::npos);
  EXPECT_EQ(text.find("flap"), std::string::npos);  // a motion without a period
}

}  // namespace
}  // namespace monarch_flight
