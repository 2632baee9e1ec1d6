#pragma once
#include <Eigen/Dense>
#include <vector>

#include "fluid/fields/slab.h"
#include "fluid/pressure/columns.h"
#include "fluid/pressure/modes.h"
#include "fluid/pressure/shared_symmetric.h"

namespace monarch_flight::fluid::pressure {

/// The wing as a low-rank change of the separable operator: on the faces f whose mobility m_f is
/// not 1 (the wing's, which let nothing through, and those beside its rim) the flux is m_f times
/// that of the separable operator.
/// With c_f = area / gap and J_f the jump of pressure across f, the change is a dipole source
/// (1 - m_f) c_f J_f. J = J0 + G s, J0 the jumps and G the answer to sources s without the change,
/// so that t = s / sqrt(c) solves  S t = sqrt(c) J0,  S = diag(1 / (1 - m)) - sqrt(c) G sqrt(c)
/// (Sherman-Morrison-Woodbury). S is symmetric; its blocks with m = 0 are positive definite, those
/// with m > 1 negative definite.
class WingCapacitance {
 public:
  /// Throws std::invalid_argument when the wing closes the whole plane of a closed box (two
  /// separate domains), std::runtime_error when S cannot be factored. Made by every process whose
  /// slab touches the plane.
  WingCapacitance(const Grid& grid, const Slab& slab, const AxisModes& x, const AxisModes& y,
                  const WingResponse& response, const Team& team);
  bool empty() const { return root_.size() == 0; }
  int wingFaces() const { return wing_faces_; }
  /// Pressures below and above the wing's plane to sources there, all per mode (nx x ny), in place.
  /// Allocates nothing; one call at a time.
  void answer(double* down, double* up) const;

 private:
  /// A face between two cells of the wing's bounding box (x fastest).
  struct Link {
    int side, first, second;  ///< side 0: below the plane, 1: above, both ends on that side
  };
  void findNormalFaces(const Grid& grid);
  void findInPlaneFaces(const Grid& grid);
  void add(double conductance, double mobility);
  void assembleNormal(const Eigen::MatrixXd& complement, double link, SymmetricTiles& system) const;
  void assembleInPlane(const WingResponse& response, SymmetricTiles& system) const;
  void toBox(const double* modes, Eigen::MatrixXd& box) const;
  void toModes(const Eigen::MatrixXd& box, double* modes) const;
  void takeJumps() const;
  int cell(int i, int j) const { return (j - j0_) * static_cast<int>(box_[0].rows()) + i - i0_; }

  int wing_faces_ = 0;
  int i0_ = 0, j0_ = 0;         ///< first cell of the bounding box
  std::vector<int> normal_;     ///< faces of the plane, between the same cell of both sides
  std::vector<Link> in_plane_;  ///< faces across the rim
  std::vector<double> list_root_, list_diagonal_;
  Eigen::VectorXd root_;               ///< sqrt(c_f) [m^1/2], first of `normal_`, then `in_plane_`
  Eigen::MatrixXd modes_x_, modes_y_;  ///< modes on the box: cells x modes
  SharedSymmetric inverse_;            ///< S^-1
  mutable Eigen::MatrixXd half_, box_[2];  ///< scratch
  mutable Eigen::VectorXd jump_, flux_;
};

}  // namespace monarch_flight::fluid::pressure
