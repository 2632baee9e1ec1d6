#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/newmark.h"
#include "monarch_flight/insect/state.h"

namespace monarch_flight {

/// Strategies of the sub-iterations: docs/coupling.md.
enum class Relaxation { kConstant, kAitken, kIqnIls, kAddedMass };

/// Which pictures of the flow are asked for when a step is committed.
struct PictureSettings {
  int surface_every = 0;  ///< steps between pictures of the wing's pressure (0: never)
  int flow_every = 0;     ///< steps between pictures of the flow around the wings (0: never)
  int flow_points = 0;    ///< points at most in a picture of the flow around a wing, >= 8
  int fields_every = 0;   ///< steps between answers with the whole flow (0: never)
};

struct CouplingSettings {
  Relaxation relaxation = Relaxation::kAddedMass;
  double omega_initial = 0.5;                ///< first (or constant) relaxation factor, (0, 1]
  double omega_min = 0.05, omega_max = 1.5;  ///< bounds of Aitken's factor (absolute value)
  int reuse_steps = 4;                       ///< earlier steps that iqn_ils learns from, 0 to 20
  int operator_every = 250;  ///< steps between load operators asked of a flow that pays for them
  double tolerance = 1e-8;  ///< on each dimensionless displacement residual: lengths over c, angles
  /// On the loads, relative to their running scales: change of the air's force and moment between
  /// sub-iterations, and what inertia is out of balance (the residual of each free acceleration).
  double load_tolerance = 1e-6;
  int max_sub_iterations = 60;
  int prescribed_steps =
      10;  ///< every coordinate follows the prescribed motion for these first steps
  /// Whether the motion's accelerations after them satisfy the equations of motion
  /// (CoupledModel::release).
  bool accelerations_known = false;
  double length_scale = 1.0;  ///< mean chord, makes displacements dimensionless [m]
  PictureSettings pictures;
  std::vector<std::string> problems() const;
};

/// One sub-iteration, for iterations.csv, the bag and the diagnosis of a failure.
struct IterationRecord {
  std::uint32_t step = 0, iteration = 0;
  std::uint32_t attempt = 1;  ///< at the step: 1 or 2
  /// In the order of kCoordinateTable; 0 for a prescribed one, infinite where a solver failed.
  std::array<double, kCoordinates> residual{};
  double load_residual =
      0.0;  ///< relative change of the air's loads and imbalance of inertia; 1 at first
  double relaxation = 0.0;  ///< factor applied after this sub-iteration
  double fluid_wall_s = 0.0;
};

/// Everything about a step that has been committed by all participants.
struct CommittedStep {
  std::uint32_t step = 0;  ///< time level, 0 is the initial state
  double t = 0.0;          ///< [s]
  Interface interface;
  PrescribedState guided;   ///< as guidance prescribed it; what is free has moved from there
  JointAngles angles;       ///< theta is that of the interface
  GuidanceReport guidance;  ///< commands taken and applied
  PerWing<Loads> loads;     ///< mirrored wings: the same twice
  Eigen::Vector3d force_I =
      Eigen::Vector3d::Zero();  ///< both wings (bare wing: the one wing), NED [N]
  bool prescribed = false;      ///< one of the prescribed start steps (or nothing is free)
  std::vector<IterationRecord> iterations;
  /// The first attempt at it failed (a step whose second one fails, too, ends the run).
  bool retried() const { return !iterations.empty() && iterations.back().attempt > 1; }
  int fluid_evaluations = 0;  ///< full evaluations of the air, those for its operator included
  /// Spectral radius of M_s^-1 M_a over the free coordinates: inertia of the air over that of the
  /// insect; 0 where nothing is free.
  double added_mass_ratio = 0.0;
  /// Work that the air does on the solved wings (mirrored: the right one) in this step: its loads
  /// along the motion that the air saw, and its generalised forces along the motion that flight and
  /// wing answered [J]. They agree as far as the step has converged.
  double work_fluid = 0.0, work_structure = 0.0;
  FluidReport fluid;  ///< of both wings together
  // The left wing's in the mirror (state.h); mirrored wings: the same twice.
  PerWing<SurfacePressure> surface;                ///< empty unless fields were due
  PerWing<FlowPicture> picture;                    ///< empty unless it was due and there is one
  PerWing<std::shared_ptr<const FlowField>> flow;  ///< null unless it was due and there is one
  std::array<double, kRoles> wall_s{};             ///< computing time by role in this step
  IgnoredMessages ignored;                         ///< of all participants since the run began
  double exchange_s = 0.0;  ///< wall time of the step's exchanges beyond that: messages and waiting
  double coupling_s = 0.0;  ///< wall time of the coordinator's own computing in this step
  double outputs_s = 0.0;   ///< wall time that the sinks took for all steps before this one
};

/// Receives every committed step, in order: files, bag, publishers, progress bar.
class StepSink {
 public:
  virtual ~StepSink() = default;
  virtual void onStep(const CommittedStep& step) = 0;
  /// A checkpoint is made: makes durable what has been written so far, and shows how to go on from
  /// here. A sink that goes on from a checkpoint is made with what it has shown.
  virtual void onCheckpoint(StateVisitor&) {}
  /// The run goes back to its start: what has been delivered is void, level 0 comes again.
  virtual void onReset() = 0;
  /// The run is over; `failure` is empty after a complete run. Called exactly once.
  virtual void onEnd(const std::string& failure) = 0;
};

}  // namespace monarch_flight
