// The quasi-steady air against somebody else's quasi-steady air: the published hover of a monarch
// (test/data/fwuav_hover.csv), where blade elements with the coefficients of Sane & Dickinson,
// without added mass and rotational terms, carry the weight exactly. Different formulation of the
// same physics: the loads must agree in size, shape and mean, not in digits.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Row = std::map<std::string, double>;

constexpr double kBeta = -0.008717319725232837;  // stroke plane of the published hover [rad]
constexpr double kWeight = 9.81 * 3.079e-4;      // [N]

std::vector<Row> published() {
  std::ifstream in(std::string(TEST_DATA_DIR) + "/fwuav_hover.csv");
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    Row row;
    std::size_t column = 0;
    for (std::string cell; std::getline(fields, cell, ','); ++column) {
      if (rows.empty() && names.size() == column) {
        names.push_back(cell);
      } else {
        row[names[column]] = std::stod(cell);
      }
    }
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

Vector3d vector(const Row& row, const std::string& name) {
  return {row.at(name + "_1"), row.at(name + "_2"), row.at(name + "_3")};
}

// Attitude and velocities of the right wing; accelerations such that the added mass carries
// nothing.
WingMotion motionOf(const Row& row, const Vector3d& mu) {
  Matrix3d R;
  for (int i = 0; i < 9; ++i) R(i % 3, i / 3) = row.at("Rcm_" + std::to_string(i + 1));
  const Vector3d euler = vector(row, "EulerR"), W = vector(row, "W");
  WingAngles angles;
  angles.phi.q = euler.x();
  angles.theta.q = euler.y();
  angles.psi.q = euler.z();
  const Matrix3d Q = wingAttitude(Side::kRight, kBeta, angles);
  WingMotion m;
  m.R_IW = R * Q;
  m.v_W = Q.transpose() * (R.transpose() * vector(row, "xdot") + W.cross(mu));
  m.omega_W = vector(row, "W_R") + Q.transpose() * W;
  m.a_W = m.omega_W.cross(m.v_W);
  return m;
}

TEST(QuasiSteadyPublished, HoverIsCarriedAndFollowed) {
  const Insect insect = loadCase("tethered_fwuav", {}, CONFIG_DIR).insect;
  const auto model =
      makeQuasiSteady(insect.wings.right.planform, Air{}, BladeElementVariant::kSaneDickinson);
  model->start(WingMotion{}, 1e-3);
  const std::vector<Row> rows = published();
  ASSERT_GE(rows.size(), 50u);
  Vector3d mean = Vector3d::Zero();
  double mine_theirs = 0.0, mine_mine = 0.0, theirs_theirs = 0.0;
  for (std::size_t i = 0; i + 1 < rows.size();
       ++i) {  // the last row is the first of the next period
    const WingMotion m = motionOf(rows[i], insect.wings.right.plate.mu);
    const Vector3d F = model->evaluate(m).force(), published_F = vector(rows[i], "F_R");
    mean += m.R_IW * F * (2.0 / static_cast<double>(rows.size() - 1));
    mine_theirs += F.z() * published_F.z();
    mine_mine += F.z() * F.z();
    theirs_theirs += published_F.z() * published_F.z();
  }
  EXPECT_NEAR(-mean.z(), kWeight, 0.1 * kWeight);
  EXPECT_LT(std::abs(mean.x()), 0.2 * kWeight);
  EXPECT_GT(mine_theirs / std::sqrt(mine_mine * theirs_theirs), 0.9);
  EXPECT_NEAR(std::sqrt(mine_mine / theirs_theirs), 1.0, 0.1);
}

}  // namespace
}  // namespace monarch_flight
