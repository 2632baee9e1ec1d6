#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/newmark.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

enum class Relaxation { kConstant, kAitken };

struct CouplingSettings {
  Relaxation relaxation = Relaxation::kAitken;
  double omega_initial = 0.5;     ///< first (or constant) relaxation factor, (0, 1]
  double omega_min = 0.05, omega_max = 1.5;  ///< bounds of Aitken's factor (absolute value)
  double tolerance = 1e-8;        ///< on each dimensionless displacement residual: x/c, z/c, theta_B, theta_R
  /// On the loads, relative to their running scales: change of the air's force and moment between
  /// sub-iterations, and what inertia is out of balance (the residual of each free acceleration).
  double load_tolerance = 1e-6;
  int max_sub_iterations = 60;
  int prescribed_steps = 10;      ///< every coordinate follows the prescribed motion for these first steps
  double length_scale = 1.0;      ///< mean chord, makes displacements dimensionless [m]
  std::vector<std::string> problems() const;
};

/// One sub-iteration, for iterations.csv, the bag and the diagnosis of a failure.
struct IterationRecord {
  std::uint32_t step = 0, iteration = 0;
  std::array<double, 4> residual{};  ///< x/c, z/c, theta_B, theta_R; 0 for a prescribed coordinate
  double load_residual = 0.0;        ///< relative change of the air's loads and imbalance of inertia; 1 at first
  double relaxation = 0.0;           ///< factor applied after this sub-iteration
  double fluid_wall_s = 0.0;
};

/// Everything about a step that has been committed by all participants.
struct CommittedStep {
  std::uint32_t step = 0;      ///< time level, 0 is the initial state
  double t = 0.0;              ///< [s]
  Interface interface;
  JointAngles angles;          ///< theta is interface.theta_R
  Loads loads;                 ///< right wing
  Eigen::Vector3d force_I = Eigen::Vector3d::Zero();  ///< both wings (bare wing: the one wing), NED [N]
  bool converged = true;
  bool prescribed = false;     ///< one of the prescribed start steps (or nothing is free)
  std::vector<IterationRecord> iterations;
  FluidReport fluid;
  SurfacePressure surface;             ///< empty unless fields were due
  std::vector<VortexPoint> vortices;   ///< empty unless fields were due
  std::array<double, 3> wall_s{};      ///< computing time of fluid, flight, wing in this step
  double exchange_s = 0.0;             ///< wall time of the step outside the participants' own computing
};

/// Receives every committed step, in order: files, bag, publishers, progress bar.
class StepSink {
 public:
  virtual ~StepSink() = default;
  virtual void onStep(const CommittedStep& step) = 0;
  /// The run is over; `failure` is empty after a complete run. Called exactly once.
  virtual void onEnd(const std::string& failure) = 0;
};

}  // namespace monarch_flight
