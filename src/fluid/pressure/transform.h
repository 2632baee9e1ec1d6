#pragma once
#include <Eigen/Dense>

#include "fluid/pressure/modes.h"

namespace monarch_flight::fluid::pressure {

/// Position of one pair of parities in the spectrum: modes (a, b), a < mx, b < my, plane k at
/// offset + (b * nz + k) * mx + a: for each b one slab of nz rows of mx contiguous modes.
struct SpectrumBlock {
  std::ptrdiff_t offset;
  int class_x, class_y;  ///< parity classes of the axes
  int mx, my;
  int first_x, first_y;  ///< number of the block's first mode among all modes of x, of y
};

/// Transforms fields of nz planes of nx * ny cells (x fastest) to the modes of x and y and back:
/// forward -Ux^T b Uy, inverse Ux p Uy^T, a few planes at a time so that they stay in cache.
/// Constant but for its scratch: one call at a time.
class PlaneTransform {
 public:
  PlaneTransform(const AxisModes& x, const AxisModes& y, int nz);
  const std::vector<SpectrumBlock>& blocks() const { return blocks_; }
  void forwardNegative(const double* field, double* spectrum) const;
  void inverse(const double* spectrum, double* field) const;

 private:
  void fold(const double* field, int k0, int planes) const;
  void unfold(double* field, int k0, int planes) const;
  double* folded(int class_x, int class_y, int planes) const;
  double* halfway(int class_x, int class_y, int planes) const;

  AxisModes x_, y_;
  int nz_, batch_;
  std::vector<SpectrumBlock> blocks_;
  mutable Eigen::VectorXd folded_, halfway_;  // [class_x][class_y][j][plane][i]
};

}  // namespace monarch_flight::fluid::pressure
