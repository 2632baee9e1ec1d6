#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

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

inline void expectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n" << text;
}

inline constexpr char kPlate[] = R"(
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

inline std::string wingRows(int n, double dt, int broken_row = -1) {
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

}  // namespace monarch_flight
