#pragma once
// A run of made-up steps and its folder, for the tests of its files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "monarch_flight/insect/insect.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"
#include "monarch_flight/run/run_outputs.h"

namespace monarch_flight {

namespace fs = std::filesystem;

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

inline Case smallCase() {
  Case c;
  c.name = "small";
  c.time = {0.1, 0.0, 0.01, 25};
  c.resolved_yaml = "name: small\n";
  c.sha256 = "0123abcd";
  c.output.record = false;
  return c;
}

// Flight at (2, 0, -1) m/s with numbers that differ in every column.
inline CommittedStep stepAt(std::uint32_t n) {
  CommittedStep s;
  s.step = n;
  s.t = 0.01 * n;
  BodyState& body = s.interface.body;
  body.x = Eigen::Vector3d(2.0, 0.0, -1.0) * s.t;
  body.v = Eigen::Vector3d(2.0, 0.0, -1.0);
  body.a = Eigen::Vector3d(0.1, 0.2, 0.3);
  body = withPitch(body, {0.1 + 0.01 * n, 1.0, 100.0});
  s.interface.theta = {{-0.2 + 0.02 * n, 2.0, 200.0}, {-0.25 + 0.02 * n, 3.0, 300.0}};
  s.angles.wings.right = {{0.4, 41, 42}, {0.5, 51, 52}, s.interface.theta.right};
  s.angles.wings.left = {{0.45, 43, 44}, {0.55, 53, 54}, s.interface.theta.left};
  s.angles.theta_A = {0.6, 61, 62};
  s.guided.rest_angle = {0.0625, 0.03125};
  s.guided.wind = {{-1, 0, 0.5}, {-11, 0, 12}};
  s.guidance.phase = 0.1 * n;
  s.guidance.clipped = 3;
  s.guidance.refused = 4;
  s.guidance.lost = n > 2;
  for (std::size_t k = 0; k < kCommands; ++k) {
    s.guidance.command.*kCommandTable[k].value = 100.0 + static_cast<double>(k);
    s.guidance.applied.*kCommandTable[k].value = 200.0 + static_cast<double>(k);
  }
  s.loads.right.force_pressure = Eigen::Vector3d(1, 2, 3);
  s.loads.right.force_friction = Eigen::Vector3d(0.25, 0.5, 0.75);
  s.loads.right.moment_pressure = Eigen::Vector3d(4, 5, 6);
  s.loads.right.moment_friction = Eigen::Vector3d(0.125, 0.25, 0.375);
  s.loads.left = s.loads.right;
  s.loads.left.force_pressure *= 10.0;
  s.loads.left.moment_pressure *= 10.0;
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
  for (std::uint32_t k = 0; k < (n <= 2 ? 1 : 3 + n % 2); ++k) {
    s.iterations.push_back(
        {n, k, k > 2 ? 2u : 1u, {1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3, 7e-3, 8e-3}, 9e-3, 0.5, 0.7});
  }
  return s;
}

inline std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

inline std::vector<double> numbers(const std::string& row) {
  std::istringstream stream(row);
  std::vector<double> result;
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(std::stod(cell));
  return result;
}

}  // namespace monarch_flight
