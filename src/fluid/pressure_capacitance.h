#pragma once
#include <Eigen/Dense>
#include <vector>

#include "fluid/pressure_modes.h"

namespace monarch_flight {

/// The wing as a low-rank change of the separable operator: on the n_w faces of the wing the flux
/// through the plane is taken away.
/// With a_f the face areas, l the conductance per area of the plane's faces and phi the modes,
///   S_fg = sqrt(a_f a_g) sum_ab phi_ab(f) phi_ab(g) (1 - l g_ab)
/// is symmetric positive definite (Sherman-Morrison-Woodbury). A jump p_d - p_u found without the
/// wing is answered by the dipole sources q = l sqrt(a) S^-1 sqrt(a) (p_d - p_u), which make the
/// flux that the separable operator sends through the wing vanish from the balance of its
/// neighbours.
class WingCapacitance {
 public:
  /// `complement`: 1 - l g per mode (nx x ny). Throws std::invalid_argument when the wing closes
  /// the whole plane of a closed box (two separate domains), std::runtime_error when S cannot be
  /// factored.
  WingCapacitance(const Grid& grid, const AxisModes& x, const AxisModes& y,
                  const Eigen::MatrixXd& complement);
  int faces() const { return static_cast<int>(root_area_.size()); }
  /// Jumps to dipole sources, both per mode (nx x ny), in place. Allocates nothing; one call at a
  /// time.
  void answer(double* modes) const;

 private:
  void findFaces(const Grid& grid);
  void assemble(const Eigen::MatrixXd& complement);
  void invert();

  double link_;                         ///< l [1/m]
  int i0_ = 0, j0_ = 0;                 ///< first cell of the wing's bounding box
  std::vector<int> face_;               ///< position of each face in the box, x fastest
  Eigen::VectorXd root_area_;           ///< sqrt(a_f) [m]
  Eigen::MatrixXd modes_x_, modes_y_;   ///< modes on the box: cells x modes
  Eigen::MatrixXd inverse_;             ///< S^-1, lower triangle
  mutable Eigen::MatrixXd half_, box_;  ///< scratch
  mutable Eigen::VectorXd jump_, flux_;
};

}  // namespace monarch_flight
