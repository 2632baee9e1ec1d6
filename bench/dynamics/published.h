#pragma once
// The published histories of the FWUAV group (test/data/fwuav_*.csv), row by row in our own terms.
#include <array>
#include <string>

#include "dynamics/rows.h"
#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/insect/numeric_table.h"

namespace monarch_flight::verify {

constexpr double kGravity = 9.81;  ///< of the histories [m/s^2]

/// A published history: file, stroke plane, hinge (kappa 0: no spring), names of its columns.
struct History {
  const char* name;
  const char* file;
  double beta, kappa, theta_0;
  bool passive;
};
inline constexpr History kHover{"hover", "fwuav_hover.csv", -0.008717319725232837, 0.0, 0.0, false};
inline constexpr History kPassive{"passive pitch",     "fwuav_passive_pitch_hover.csv",
                                  0.6283185307179586,  4.071433271890511e-05,
                                  -0.4184977496324338, true};

/// Masses and inertias of test/data/monarch_morphology_fwuav.json as the histories use them; the
/// wing's mass centre has half the plate's spanwise distance there.
Insect publishedInsect(const History& history);

/// Rows of a published history by the names of its columns.
class Rows {
 public:
  explicit Rows(const std::string& path) : table_(readCsv(path)) {}
  std::size_t size() const { return table_.rows.size(); }
  double operator()(std::size_t row, const std::string& column) const {
    const int i = table_.find(column);
    if (i < 0) throw std::runtime_error(table_.name + ": no column " + column);
    return table_.rows[row][static_cast<std::size_t>(i)];
  }
  Eigen::Vector3d vector(std::size_t row, const std::string& name, int first = 1) const {
    const auto at = [&](int i) { return (*this)(row, name + "_" + std::to_string(first + i)); };
    return {at(0), at(1), at(2)};
  }

 private:
  NumericTable table_;
};

/// What one row says: motion, loads and joint torques. The published attitudes leave SO(3) by up to
/// 1.1e-7; the body's is the nearest rotation, and its v and a - g are those that the published
/// equations, which turn them by the transpose, have in body axes.
struct Sample {
  BodyState body;
  Eigen::Matrix3d R_IB;  ///< as published
  Eigen::Vector3d a;     ///< as published, NED [m/s^2]
  JointAngles angles;
  std::array<Eigen::Matrix<double, 6, 1>, 3> loads;
  /// On right wing, left wing, abdomen, body axes, no spring.
  std::array<Eigen::Vector3d, 3> torques;
  InsectMotion motion(double beta) const { return insectMotion(beta, body, angles); }
};

Sample sampleOf(const History& history, const Rows& rows, std::size_t n);

/// Rows 4-6 as published: sum mu x Q F for the air and -sum Q tau for the joints.
Eigen::Vector3d publishedMomentRow(const MultibodyDynamics& dynamics, const Insect& insect,
                                   const Sample& s);

/// Body pitch over the published hover with either moment row, and a table of the three curves.
DynamicsRows checkAttitude(const DynamicsFolders& folders);

}  // namespace monarch_flight::verify
