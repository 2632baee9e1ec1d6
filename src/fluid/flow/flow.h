#pragma once
#include <functional>
#include <memory>

#include "fluid/fields/field.h"
#include "fluid/fields/frame.h"
#include "fluid/loads/load_operator.h"
#include "fluid/momentum/momentum.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/fluid/pressure_solver.h"

namespace monarch_flight::fluid {

/// A flow known everywhere: velocity relative to the wind, inertial axes, at the place r_I and the
/// time t since the start.
using KnownFlow = std::function<Eigen::Vector3d(const Eigen::Vector3d& r_I, double t)>;

/// One stored time level. The field's components are those in `axes`: the wing's axes as they were
/// predicted for the step, O(dt^3) beside where the wing then was. Within a step, and in pictures,
/// they stand for the wing's own: velocities of the wall and loads have the same numbers in both.
/// But the next step turns the field from these axes; if it turned it from the wing's, the air
/// would turn with the error of every prediction.
struct Level {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();       ///< components to inertial ones
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();  ///< of the grid at that time
  GridVelocity grid;  ///< of the grid at that time, in its own axes then
  WallVelocity wall;  ///< resolved in `axes`
};

/// Incompressible flow on a grid that is fixed to the wing. Unknown: the absolute velocity
/// (relative to the wind), resolved in wing axes (see Level). Method: docs/fluid.md.
class NavierStokes : public FluidModel {
 public:
  /// On the processes of `comm` (default: this one alone); all of them call every function alike.
  NavierStokes(Grid grid, const Air& air, double reference_length, double courant_limit,
               MPI_Comm comm = MPI_COMM_NULL, int threads = 1);

  void start(const WingMotion& motion, double dt) override;
  Loads evaluate(const WingMotion& next) override;
  /// By unit evaluations: exact, for within a step the loads are affine in the wall's velocity.
  Loads linearise(const WingMotion& next, LoadOperator& jacobian) override {
    return loads::affineLinearise(*this, next, jacobian);
  }
  int operatorCost() const override { return loads::kAffineEvaluations; }
  void commit() override;
  std::vector<char> save() const override;
  void restore(const std::vector<char>& bytes) override;
  Matrix6d addedMass() const override { return added_mass_; }
  FluidReport report() const override { return report_; }
  long cells() const override { return grid_.cells(); }
  SurfacePressure surfacePressure() const override;
  FlowPicture flowPicture(std::size_t limit) const override;
  std::shared_ptr<const FlowField> flowField() const override;

  const Grid& grid() const { return grid_; }
  const Layout& layout() const { return layout_; }
  const Slab& slab() const { return slab_; }
  const Velocity& velocity() const { return requireCommitted(), vn_; }  ///< committed level n
  /// Takes components of velocity() to inertial ones.
  const Eigen::Matrix3d& axes() const { return requireCommitted(), level_n_.axes; }
  const Array& pressure() const { return p_; }  ///< committed, cell (i, j, k) at face (i, j, k)
  /// Replaces the air at rest by a known flow: levels 0 and -1 and, from then on, the values on a
  /// closed outer boundary. For verification: it is not part of the saved state. After start().
  void setKnownFlow(KnownFlow flow);

 private:
  void easeIn(const WingMotion& next);
  void takePart(double part, const WingMotion& next);
  void prepareStep();
  Loads solve(const WingMotion& next);
  WallVelocity wallAcceleration() const;
  void complete();
  template <class Stream, class Flow>
  static void exchange(Stream& s, Flow& flow);  ///< the saved state
  void predictPlace();
  void turnLevel(Velocity& v, Level& level);
  void convectingField(const GridVelocity& grid_velocity);
  double courant();
  /// Between the two levels of the grid's motion; before the first step level -1 is made.
  double levelDistance() const { return length_before_ > 0 ? length_before_ : length_; }
  Matrix6d computeAddedMass();
  void potentialStart();
  void setLevelBefore(const Eigen::Vector3d& V_dot, const Eigen::Vector3d& omega_dot);
  void fillFarField(const Eigen::Isometry3d& place, Velocity& v) const;

  Eigen::Vector3d velocityAt(int i, int j, int k) const;  ///< committed, at the cell's centre
  Eigen::Matrix3d gradientAt(int i, int j, int k) const;
  double frictionAt(int component, int i, int j, int side) const;
  std::vector<FlowField::WingFace> wingFaces() const;

  double* phi() { return phi_.data() + phi_start_; }  ///< of this process's first cell
  void fillPhiHalo();
  /// Between evaluate and commit the velocities are those in the axes of the next level:
  /// std::logic_error.
  void requireCommitted() const;

  Grid grid_;
  Slab slab_;
  Team team_;
  Layout layout_;
  Air air_;
  double reference_length_, courant_limit_;
  PressureSolver pressure_;
  momentum::Momentum momentum_;
  Matrix6d added_mass_;

  // committed state
  double dt_ = 0;
  double length_ = 0;         ///< of the next step: dt_, but in parts of the first one
  double length_before_ = 0;  ///< of the committed one; 0: none
  long steps_ = 0;            ///< committed since start
  bool prepared_ = false;     ///< levels are turned into the predicted axes of n+1
  Level level_n_, level_m_;   ///< n and n-1
  Velocity vn_, vm_;
  Array p_;
  WallVelocity committed_acceleration_{};  ///< of the wing's points, own axes [m/s^2]
  KnownFlow known_;                        ///< empty: air at rest

  // of the step being computed
  momentum::MomentumStep step_{};
  Velocity convecting_, v_star_;
  Array phi_;  ///< one plane of the process below, then this process's cells
  std::ptrdiff_t phi_start_;
  Array row_;    ///< scratch of the loads
  Array rates_;  ///< of the planes: largest Courant number by dt
  Eigen::Isometry3d predicted_ = Eigen::Isometry3d::Identity();  ///< place of the grid
  Level next_;
  WallVelocity acceleration_;
  bool evaluated_ = false;
  FluidReport report_;
};

}  // namespace monarch_flight::fluid
