#pragma once
#include <array>
#include <string>
#include <vector>

#include "monarch_flight/insect/fourier_motion.h"
#include "monarch_flight/math/eigen.h"
#include "monarch_flight/run/case.h"
#include "monarch_flight/trim/flap_state.h"

namespace monarch_flight {

/// A number of the case file that the trim may change.
struct TrimParameter {
  std::string name;               ///< on the command line
  std::vector<std::string> path;  ///< keys in the resolved case; a list's index as a number
  std::string unit;
  double scale = 1.0;            ///< a change that matters, makes it dimensionless
  double low = 0.0, high = 0.0;  ///< range in which it may be fitted
};

/// Known parameters (m_B, m_A, m_R, kappa, theta_0, root_x, root_z, hinge), ranges empty.
const std::vector<TrimParameter>& trimParameters();

/// Periodic part of the motion of x, z [m], theta_B, theta_R [rad] over a flap: what the run-in
/// flies. Its values at the start do not matter, they are made to fit the state.
struct FlapShape {
  FourierSeries x, z, theta_B, theta_R;
};

/// A point of the search.
struct TrimPoint {
  FlapState state = FlapState::Zero();
  Eigen::VectorXd parameters;  ///< in the order of FlapMap::parameters()
  FlapShape shape;             ///< only for a run-in
};

/// One flap as flown.
struct Flap {
  FlapState start = FlapState::Zero(), end = FlapState::Zero();
  double speed = 0.0;         ///< of the mean velocity [m/s]
  double climb = 0.0;         ///< of the mean velocity, up from the horizontal [rad]
  double turn = 0.0;          ///< change of the heading [rad]
  double theta_B_mean = 0.0;  ///< [rad]
  double theta_B_swing = 0.0, theta_R_swing = 0.0;  ///< largest minus smallest [rad]
  double theta_B_largest = 0.0;                     ///< |theta_B| [rad]
  FlapShape shape;
};

struct Flight {
  bool complete = false;
  std::string failure;
  std::vector<Flap> flaps;  ///< free ones, run-in apart
  double wall_s = 0.0;      ///< of all flaps, run-in included
};

/// The map from the state at the start of a flap to the state at its end, for a case whose motion
/// is a Fourier series with a period. Without run-in the flight starts at the state, with the
/// accelerations that belong to it (for air without memory). With a run-in the first `run_in` flaps
/// are prescribed: a periodic flight (FlapShape) that passes through the state at their end, so
/// that the wake is there when the insect is released.
class FlapMap {
 public:
  /// Throws InputError when the case has no flapping period, is no Fourier motion, has nothing
  /// free, is not made of whole steps a flap, or `run_in` < 0 (> 0 where the flight leaves the
  /// plane of symmetry: the run-in does not).
  FlapMap(const Case& c, const std::string& config_dir, std::vector<TrimParameter> parameters,
          int run_in);

  const Case& baseCase() const { return base_; }
  const std::vector<TrimParameter>& parameters() const { return parameters_; }
  const std::vector<int>& active() const { return active_; }  ///< states that are free
  int runIn() const { return run_in_; }
  /// Start as the case has it: at t_start, parameters as in the case.
  TrimPoint start() const;
  /// `flaps` free flaps from a point. Thread-safe.
  Flight fly(const TrimPoint& point, int flaps) const;
  /// Text of the case that flies `flaps` free flaps from a point, behind a run-in of `run_in_steps`
  /// steps in which the point's periodic flight is prescribed. That flight has the point's state
  /// at t_start, and so at a release after whole flaps. A state out of the plane of symmetry is
  /// given as the explicit start instead, without run-in.
  std::string caseText(const TrimPoint& point, int run_in_steps, int flaps) const;

 private:
  Case withStart(const TrimPoint& point, const FlapState& accelerations) const;
  FlapState consistentAccelerations(const TrimPoint& point) const;

  Case base_;
  std::string config_dir_;
  std::vector<TrimParameter> parameters_;
  std::vector<int> active_;
  int run_in_;
  std::uint32_t per_flap_ = 0;  // steps
};

}  // namespace monarch_flight
