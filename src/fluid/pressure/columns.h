#pragma once
#include <Eigen/Dense>
#include <vector>

#include "fluid/fields/slab.h"
#include "fluid/pressure/transform.h"

namespace monarch_flight::fluid::pressure {

/// Per mode of the plane (nx x ny): what the columns answer at the wing's plane. With unit sources
/// r_d, r_u: p_d = below r_d + cross r_u, p_u = cross r_d + above r_u; `complement` is 1 - l g, g
/// the jump p_d - p_u that answers a unit source below and a unit sink above.
struct WingResponse {
  Eigen::MatrixXd below, cross, above, complement;
};

/// The tridiagonal systems in z, one per mode (a, b) of the plane:
///   (Kz + (lambda_a + lambda_b) Wz) p = r,   Kz: face conductances 1 / gap, Wz = diag(width),
/// eliminated from both ends towards the two cells next to the wing's plane (below: k_wing - 1,
/// above: k_wing), where what is left is  [ e_d + l, -l ; -l, e_u + l ] (p_d; p_u) = (r_d; r_u),
/// l = 1 / gap[k_wing]. e_d, e_u >= 0 are what the half columns conduct to elsewhere; they are
/// built without subtraction. With closed outer faces the constant mode has e_d = e_u = 0: its
/// system is singular, r_d + r_u = 0 after removeMean, and the solution with p_d + p_u = 0 is
/// taken. A spectrum holds the planes of this process's slab; reduced rows pass from process to
/// process towards the wing's plane and solved ones back. All arrays over modes ("mode planes") are
/// nx x ny: all modes of x by all modes of y.
class PressureColumns {
 public:
  PressureColumns(const Grid& grid, const Slab& slab, const AxisModes& x, const AxisModes& y,
                  std::vector<SpectrumBlock> blocks, const Team& team);
  WingResponse wingResponse() const;

  /// The constant mode's r made to sum to zero (a multiple of width taken off). Closed outer faces
  /// only.
  void removeMean(double* spectrum) const;
  /// Both eliminations, up to the wing's plane.
  void eliminate(double* spectrum) const;
  /// Takes r_d and r_u to the processes that touch the wing's plane.
  void meet(const double* spectrum) const;
  /// True where r_d and r_u are known after `meet`.
  bool touchesWing() const { return slab_.k0() <= k_wing_ && slab_.k1() >= k_wing_; }
  /// p_d and p_u per mode as the eliminated system stands.
  void wingPressures(double* down, double* up) const;
  /// r_d += down, r_u += up.
  void addSources(const double* down, const double* up) const;
  /// p_d and p_u into the spectrum, where they are of this process.
  void solveAtWing(double* spectrum) const;
  /// Back-substitution outwards from there.
  void substitute(double* spectrum) const;
  /// The constant mode shifted to zero volume mean. Closed outer faces only.
  void centre(double* spectrum) const;

 private:
  std::ptrdiff_t planeIndex(const SpectrumBlock& q, int b) const {
    return q.first_x + static_cast<std::ptrdiff_t>(q.first_y + b) * nx_;
  }
  /// Row k of block q, mode b of y, in an array laid out as the spectrum.
  std::ptrdiff_t row(const SpectrumBlock& q, int b, int k) const {
    return q.offset + (static_cast<std::ptrdiff_t>(b) * slab_.planes() + k - slab_.k0()) * q.mx;
  }
  /// Calls work(block, mode b of y) for all of them.
  template <class Work>
  void eachRow(Work work) const {
    team_.each(0, static_cast<int>(rows_.size()),
               [&](int r, int) { work(blocks_[rows_[r].block], rows_[r].b); });
  }
  void takePlane(const double* spectrum, int k, double* plane) const;
  void eliminateHalf(double* spectrum, int half) const;
  void substituteHalf(double* spectrum, int half) const;
  void factor(const SpectrumBlock& q, int b, const Eigen::ArrayXd& lambda);

  struct Row {
    int block, b;
  };

  const Slab slab_;
  const Team team_;
  int nx_, ny_, nz_, k_wing_;
  std::vector<SpectrumBlock> blocks_;
  std::vector<Row> rows_;        ///< of the spectrum: all modes b of y of all blocks
  Eigen::ArrayXd width_, link_;  ///< cells; faces (1 / gap, 0 at a closed end)
  Eigen::ArrayXd reciprocal_;    ///< of the pivots, laid out as the spectrum
  /// Inverse of the 2 x 2 systems, and 1 - l g, as mode planes.
  Eigen::ArrayXd below_, cross_, above_, complement_;
  mutable Eigen::ArrayXd r_d_, r_u_, passing_;  ///< mode planes: at the wing; between processes
};

}  // namespace monarch_flight::fluid::pressure
