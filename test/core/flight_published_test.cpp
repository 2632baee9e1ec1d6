// Against the published histories of the FWUAV group (test/data/fwuav_*.csv). Their equations put
// the joint torques and the aerodynamic moments wrongly into the body's moment rows, so body
// attitude is taken from the data, and linear momentum, joint torques and wing pitch are compared
// (docs/model).
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/test_insect.h"
#include "monarch_flight/wing/wing_pitch_solver.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kTolerance = 1e-8;               // relative to the largest of the history
constexpr double kKappa = 4.071433271890511e-05;  // of the passive pitch history [N m/rad]
constexpr double kTheta0 = -0.4184977496324338;

/// One row of a published table by column name.
class Row {
 public:
  explicit Row(std::map<std::string, double> values) : values_(std::move(values)) {}
  double operator()(const std::string& name) const { return values_.at(name); }
  Vector3d vector(const std::string& name, int first = 1) const {
    return {number(name, first), number(name, first + 1), number(name, first + 2)};
  }
  Matrix3d matrix(const std::string& name, int first = 1) const {
    Matrix3d R;
    R << vector(name, first), vector(name, first + 3), vector(name, first + 6);
    return R;
  }

 private:
  double number(const std::string& name, int i) const {
    return values_.at(name + "_" + std::to_string(i));
  }
  std::map<std::string, double> values_;
};

std::vector<Row> published(const std::string& file) {
  std::ifstream in(std::string(TEST_DATA_DIR) + "/" + file);
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    std::map<std::string, double> values;
    for (std::size_t i = 0; i < names.size(); ++i) values[names[i]] = std::stod(cells[i]);
    rows.emplace_back(values);
  }
  return rows;
}

/// Angles of the right wing with phi'' and psi'' recovered from the published derivative of
/// Omega_R.
WingAngles wingAngles(const Vector3d& euler, const Vector3d& euler_dot, const Vector3d& rate_dot) {
  WingAngles angles;
  angles.phi = {euler.x(), euler_dot.x(), 0.0};
  angles.theta = {euler.y(), euler_dot.y(), 0.0};
  angles.psi = {euler.z(), euler_dot.z(), 0.0};
  const Vector3d rest = rate_dot - wingRateDerivative(angles);  // linear in the second derivatives
  const double ct = std::cos(angles.theta.q), st = std::sin(angles.theta.q);
  angles.phi.qdd = (rest.x() * ct + rest.z() * st) / std::cos(angles.psi.q);
  angles.psi.qdd = rest.x() * st - rest.z() * ct;
  angles.theta.qdd = rest.y() - angles.phi.qdd * std::sin(angles.psi.q);
  return angles;
}

/// Loads on a wing as published, its side being R or L.
Eigen::Matrix<double, 6, 1> airLoad(const Row& row, const std::string& side) {
  Eigen::Matrix<double, 6, 1> load;
  load << row.vector("F_" + side), row.vector("M_" + side);
  return load;
}

/// A row of either file as a motion of our insect. Both wings have their own pitch: the published
/// insect loses its symmetry to rounding.
struct Sample {
  BodyState body;
  JointAngles angles;
  Matrix3d R_IB;  // as published: leaves SO(3) by up to 1.1e-7
};

Sample hoverSample(const Row& row) {
  Sample s;
  s.R_IB = row.matrix("Rcm");
  s.body.q_IB = orthonormalised(s.R_IB);
  s.body.v = row.vector("xdot");
  s.body.a = row.vector("xddot");
  s.body.Omega_B = row.vector("W");
  s.body.Omega_dot_B = row.vector("Wdot");
  s.angles.wings = testing::both(
      wingAngles(row.vector("EulerR"), row.vector("EulerRdot"), row.vector("W_Rdot")));
  s.angles.theta_A = {row("thetaA"), row("W_A_2"), row("W_Adot_2")};
  return s;
}

Sample passiveSample(const Row& row) {
  Sample s;
  s.R_IB = row.matrix("X", 4);
  s.body.q_IB = orthonormalised(s.R_IB);
  s.body.v = row.vector("X", 13);
  s.body.a = row.vector("X_dot", 13);
  s.body.Omega_B = row.vector("X", 16);
  s.body.Omega_dot_B = row.vector("X_dot", 16);
  s.angles.wings = testing::both(
      wingAngles(row.vector("Euler_R"), row.vector("Euler_R_dot"), row.vector("W_R_dot")));
  s.angles.wings.left.theta = {row("X_20"), row("X_22"), row("X_dot_22")};
  s.angles.theta_A = {row("theta_A"), row("W_A_2"), row("W_A_dot_2")};
  return s;
}

/// Relative to the largest of the whole history; `spring` is the hinge's torque about e2, which the
/// published joint torques leave out.
template <typename MakeSample, typename Spring>
void compare(const std::string& file, double beta, MakeSample sample, Spring spring) {
  Insect insect = testing::publishedMonarch();
  insect.beta = beta;
  const MultibodyDynamics dynamics(insect, kGravity);
  const std::vector<Row> rows = published(file);
  ASSERT_EQ(rows.size(), 51u);
  double force_scale = 0.0, torque_scale = 0.0;
  for (const Row& row : rows) {
    force_scale = std::max(force_scale, row.vector("f_a").norm());
    torque_scale = std::max(torque_scale, row.vector("tau").norm());
  }
  for (const Row& row : rows) {
    const Sample s = sample(row);
    // That the published attitude is no rotation limits the comparison of forces.
    const double force_tolerance =
        (kTolerance + (s.R_IB.transpose() * s.R_IB - Matrix3d::Identity()).norm()) * force_scale;
    const InsectMotion motion = insectMotion(beta, s.body, s.angles);
    EXPECT_LT((motion.joints[0].Omega - row.vector("W_R")).norm(), kTolerance * 100.0);
    const Vector15d air = dynamics.appliedForce(
        motion, {airLoad(row, "R"), airLoad(row, "L"), Eigen::Matrix<double, 6, 1>::Zero()});
    const Vector3d air_B = s.body.R_IB().transpose() * air.head<3>();
    EXPECT_LT((s.R_IB * air_B - row.vector("f_a")).norm(), kTolerance * force_scale) << row("t");
    const Vector15d rest = dynamics.inertialForce(motion) - dynamics.gravityForce(motion) - air;
    EXPECT_LT(rest.head<3>().norm(), force_tolerance) << row("t");
    for (int i = 0; i < 3; ++i) {
      Vector3d torque = rest.segment<3>(6 + 3 * i);
      if (i < 2) torque.y() -= spring(s.angles.wings[kSides[static_cast<std::size_t>(i)]].theta.q);
      const Vector3d published = row.vector("tau", 1 + 3 * i);  // in body axes
      EXPECT_LT((motion.joints[static_cast<std::size_t>(i)].Q * torque - published).norm(),
                kTolerance * torque_scale)
          << row("t") << " joint " << i;
    }
  }
}

TEST(PublishedHover, LinearMomentumAndJointTorques) {
  compare("fwuav_hover.csv", -0.008717319725232837, hoverSample, [](double) { return 0.0; });
}

TEST(PublishedPassivePitch, LinearMomentumAndJointTorques) {
  compare("fwuav_passive_pitch_hover.csv", 0.6283185307179586, passiveSample,
          [](double theta) { return -kKappa * (theta - kTheta0); });
}

TEST(PublishedPassivePitch, WingPitchEquation) {
  Insect insect = testing::publishedMonarch();
  insect.beta = 0.6283185307179586;
  for (Side side : kSides) {
    insect.wings[side].kappa = kKappa;
    insect.wings[side].theta_0 = kTheta0;
  }
  const WingPitchSolver solver(Side::kRight, insect, kGravity, Newmark());
  double largest = 0.0;
  const std::vector<Row> rows = published("fwuav_passive_pitch_hover.csv");
  for (const Row& row : rows) largest = std::max(largest, std::abs(row("X_dot_21")));
  for (const Row& row : rows) {
    const Sample s = passiveSample(row);
    Loads loads;
    loads.force_pressure = row.vector("F_R");
    loads.moment_pressure = row.vector("M_R");
    EXPECT_NEAR(solver.acceleration(s.body, s.angles, loads), row("X_dot_21"), kTolerance * largest)
        << row("t");
  }
}

}  // namespace
}  // namespace monarch_flight
