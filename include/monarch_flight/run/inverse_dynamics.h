#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/math/eigen.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// What must act on one wing's hinge besides air and gravity; the left one as its mirror image
/// (state.h).
struct HingeLoad {
  Coordinate theta;         ///< wing pitch [rad]
  double rest_angle = 0.0;  ///< shift of the spring's rest angle by guidance [rad]
  Eigen::Vector3d torque =
      Eigen::Vector3d::Zero();  ///< of the joint, wing axes, spring included [N m]
};

/// What must act besides air and gravity so that a motion happens (inverse dynamics), at one time.
struct RequiredLoads {
  double t = 0.0;  ///< [s]
  PerWing<HingeLoad> wings;
  double abdomen = 0.0;  ///< torque of the abdomen's joint about y [N m]
  Eigen::Vector3d force =
      Eigen::Vector3d::Zero();  ///< on the whole insect, F_I [N]; zero where x, y, z are free
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about the body's mass centre, body axes
                                                     ///< [N m]; zero where it is free to turn
};

/// Required loads of every row of a flight.csv (docs/run_files.md), which tells motion and air
/// loads. InputError where a column is missing or the insect is a bare wing.
std::vector<RequiredLoads> requiredLoads(const Case& c, const NumericTable& flight);

/// The linear hinge that comes nearest to the required torque about the pitch axis (least squares):
///   torque = -kappa (theta - rest_angle - theta_0) - damping theta'.
struct HingeFit {
  double kappa = 0.0;         ///< [N m/rad]
  double theta_0 = 0.0;       ///< [rad]
  double damping = 0.0;       ///< [N m s/rad]; below zero the hinge must do work on the wing
  double spring_share = 0.0;  ///< share of the torque's variance that a spring alone explains
  double damped_share = 0.0;  ///< the same for spring and damper
  double spring_kappa = 0.0, spring_theta_0 = 0.0;  ///< of the spring alone
  double torque_rms = 0.0;                          ///< of the required torque about its mean [N m]
  double power = 0.0;                               ///< mean power of the required torque [W]
};

/// Of one wing. Needs three rows or more and a wing that pitches; InputError otherwise.
HingeFit fitHinge(const std::vector<RequiredLoads>& rows, Side side);

/// Writes t and the required loads with a header line.
void writeRequiredLoads(const std::vector<RequiredLoads>& rows, std::ostream& out);

/// monarch inverse-dynamics: reads case.yaml and flight.csv of the folder `run`, takes the flaps
/// `from` to `to` (counted from 0, `to` < 0: to the end), writes inverse_dynamics.csv into the
/// folder and a summary to `out`, of both hinges where wings are independent. InputError for a
/// folder without them and an empty window.
void runInverseDynamics(const std::string& run, double from, double to,
                        const std::string& config_dir, std::ostream& out);

}  // namespace monarch_flight
