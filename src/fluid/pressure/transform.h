#pragma once
#include <Eigen/Dense>

#include "fluid/fields/team.h"
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
/// The few planes are the work of one thread. Constant but for its scratch: one call at a time.
class PlaneTransform {
 public:
  PlaneTransform(const AxisModes& x, const AxisModes& y, int nz, const Team& team);
  const std::vector<SpectrumBlock>& blocks() const { return blocks_; }
  void forwardNegative(const double* field, double* spectrum) const;
  /// Of the planes [begin, end).
  void inverse(const double* spectrum, double* field, int begin, int end) const;

 private:
  /// Planes of a batch, laid out [class_x][class_y][j][plane][i]: folded by parity; half
  /// transformed.
  struct Scratch {
    Eigen::VectorXd folded, halfway;
  };
  void fold(const double* field, int k0, int planes, Scratch& s) const;
  void unfold(double* field, int k0, int planes, Scratch& s) const;
  std::ptrdiff_t part(std::size_t class_x, std::size_t class_y, int planes) const;

  AxisModes x_, y_;
  int nz_, batch_;
  Team team_;
  std::vector<SpectrumBlock> blocks_;
  mutable std::vector<Scratch> scratch_;  ///< one a thread
};

}  // namespace monarch_flight::fluid::pressure
