#pragma once
#include <cstdint>
#include <vector>

namespace monarch_flight {

struct Axis;

/// How much the air on a face of the grid moves for the difference of pressure across it: 0 on the
/// wing, 1 elsewhere, and more than 1 on the faces beside the wing's rim.
///
/// Round a sharp rim p ~ sqrt(r) sin(theta / 2), and velocity ~ 1 / sqrt(r): a difference of point
/// values misses the mean gradient on the faces next to the rim by a fixed factor, and the plate
/// acts as if it were 0.29 cells larger all round. The mobility is that factor, exact for the
/// singular solution (times one number that stands for the faces farther away). It is an inertia of
/// 1 / mobility: all else in the balance of momentum of such a face stands as elsewhere, so that
/// slow, viscous flow round the rim does not feel it.
class Mobility {
 public:
  Mobility() = default;
  /// Axes and mask as in Grid.
  Mobility(const Axis& x, const Axis& y, const Axis& z, int k_wing,
           const std::vector<std::uint8_t>& wing);

  /// Of the nx lower faces, in direction `component`, of the cells of row j in plane k; null where
  /// all are 1.
  const double* row(int component, int j, int k) const {
    const std::vector<double>* plane = find(component, k);
    return plane ? plane->data() + static_cast<std::size_t>(j) * nx_ : nullptr;
  }
  double at(int component, int i, int j, int k) const {
    const double* r = row(component, j, k);
    return r ? r[i] : 1;
  }

  /// Mean gradient over difference quotient in the singular solution, for cells of height
  /// `aspect` times their width: normal to the wing's plane on the first face outside, and within
  /// the plane across the rim.
  static double besideRim(double aspect);
  static double acrossRim(double aspect);

 private:
  const std::vector<double>* find(int component, int k) const {
    if (empty_ || k > k_wing_ || k < k_wing_ - (component != 2)) return nullptr;
    return component == 2 ? &normal_ : &in_plane_[component][k - k_wing_ + 1];
  }

  bool empty_ = true;  ///< no wing
  int nx_ = 0, k_wing_ = 0;
  std::vector<double> normal_;          ///< nx * ny: faces of the wing's plane
  std::vector<double> in_plane_[2][2];  ///< x, y; planes of cells below and above the wing
};

}  // namespace monarch_flight
