#pragma once
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/fluid/flow_field.h"
#include "monarch_flight/fluid/flow_picture.h"
#include "monarch_flight/fluid/kernel_times.h"
#include "monarch_flight/insect/state.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Pressure on the wing's surface, for pictures: a structured set of flat rectangles in wing axes.
struct SurfacePressure {
  struct Facet {
    float x, y, dx, dy;      ///< centre and size, wing axes [m]
    float p_upper, p_lower;  ///< gauge pressure on the dorsal (-z) and ventral (+z) side [Pa]
  };
  std::vector<Facet> facets;
};

/// Jacobian of the loads (force; moment) at level n+1, wing axes, with respect to the wing's
/// velocity (v_W; omega_W) and its acceleration (a_W; alpha_W), each with the others kept.
struct LoadOperator {
  Matrix6d velocity = Matrix6d::Zero();      ///< [N s/m, N s, N m s/m, N m s]
  Matrix6d acceleration = Matrix6d::Zero();  ///< [kg, kg m, kg m, kg m^2]
};

/// What a flow model says of itself after an evaluation.
struct FluidReport {
  double courant = 0.0;  ///< largest in-plane Courant number of the step (0: not applicable)
  /// Largest net outflow of a cell over (its largest face x largest speed), of the committed flow;
  /// taken after steps 1, 51, 101, ... (0: not applicable).
  double divergence = 0.0;
  /// Constants of the run for summary.json. The fluid participant fills them in its answer to START
  /// (from FluidModel::cells, addedMass, operatorCost) and the coordinator hands that report on
  /// with step 0; later they are 0.
  long cells = 0;
  Matrix6d added_mass = Matrix6d::Zero();
  int operator_cost = 0;   ///< FluidModel::operatorCost
  KernelTimes kernel_s{};  ///< wall time by kernel since `start` (0: no grid), of process 0
};

/// Of two flows: the larger Courant number and divergence, the sum of cells and times.
FluidReport together(const FluidReport& a, const FluidReport& b);

/// The one contract of all flow models. A model owns a committed state at time level n. Its air is
/// at rest far away: the motions it is given are relative to the wind (relativeTo,
/// prescribed_motion.h). `evaluate` is a pure function of (committed state, motion): it may be
/// called any number of times with different or equal motions and changes nothing that a later
/// evaluate could see (but for parts of a first step, docs/fluid.md).
class FluidModel {
 public:
  virtual ~FluidModel() = default;
  /// Starts from air at rest with the wing in this motion at time level 0;
  /// `dt` is the time step of all that follows [s].
  virtual void start(const WingMotion& motion, double dt) = 0;
  /// Loads at level n+1 if the wing moves to `next`. Throws NumericalError on a non-finite result,
  /// std::logic_error before `start` or `restore`.
  virtual Loads evaluate(const WingMotion& next) = 0;
  /// As `evaluate`, the same loads bit for bit, with their Jacobian at `next`.
  virtual Loads linearise(const WingMotion& next, LoadOperator& jacobian) = 0;
  /// Evaluations that the Jacobian costs on top of that; 0: as good as nothing.
  virtual int operatorCost() const = 0;
  /// Makes the last evaluated step the committed state. Throws std::logic_error when nothing was
  /// evaluated since the last commit, or the last evaluation threw.
  virtual void commit() = 0;
  /// Exact state as bytes and back; bitwise the same evaluations follow. Throws
  /// std::invalid_argument for the state of another wing, grid or number of processes.
  virtual std::vector<char> save() const = 0;
  virtual void restore(const std::vector<char>& bytes) = 0;

  /// Added mass about the wing root, wing axes, SI: force and moment on the air = M (a_W; alpha_W).
  virtual Matrix6d addedMass() const = 0;
  virtual FluidReport report() const = 0;
  virtual long cells() const = 0;  ///< 0 when there is no grid
  /// Of the committed level, also between evaluate and commit and after restore; zero after start.
  virtual SurfacePressure surfacePressure() const = 0;
  /// Of the committed level, as `flowField`. Velocities stand in the axes of the next level while
  /// it is computed: both throw std::logic_error between evaluate and commit. The vortices around
  /// the wing on at most `limit` points (>= 8); empty where there is no field.
  virtual FlowPicture flowPicture(std::size_t /*limit*/) const { return {}; }
  /// The committed level as a whole; null where there is no field.
  virtual std::shared_ptr<const FlowField> flowField() const { return nullptr; }
};

/// Properties of the air.
struct Air {
  double rho = 1.225;  ///< [kg/m^3]
  double mu = 1.8e-5;  ///< dynamic viscosity [Pa s]
};

}  // namespace monarch_flight
