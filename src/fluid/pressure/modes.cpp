#include "fluid/pressure/modes.h"

#include <lapacke.h>

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

namespace monarch_flight::fluid::pressure {
namespace {

bool isSymmetric(const Axis& axis) {
  const int n = axis.n();
  if (n % 2 != 0) return false;
  for (int i = 0; i < n / 2; ++i) {
    const double a = axis.width[i], b = axis.width[n - 1 - i];
    if (std::abs(a - b) > 1e-11 * a) return false;
  }
  return true;
}

/// Modes of m cells with these widths, whose end faces have these conductances.
/// The symmetric form is W^-1/2 K W^-1/2 y = lambda y, u = W^-1/2 y.
ModeClass tridiagonalModes(const Eigen::VectorXd& width, double conductance_low,
                           double conductance_high) {
  const int m = static_cast<int>(width.size());
  ModeClass modes;
  modes.values.resize(m);
  modes.vectors.resize(m, m);
  Eigen::VectorXd off(m);
  double below = conductance_low;
  for (int i = 0; i < m; ++i) {
    const double above = i + 1 < m ? 2.0 / (width[i] + width[i + 1]) : conductance_high;
    modes.values[i] = (below + above) / width[i];
    if (i + 1 < m) off[i] = -above / std::sqrt(width[i] * width[i + 1]);
    below = above;
  }
  const int info = LAPACKE_dstevd(LAPACK_COL_MAJOR, 'V', m, modes.values.data(), off.data(),
                                  modes.vectors.data(), m);
  if (info == LAPACK_WORK_MEMORY_ERROR) throw std::bad_alloc();
  if (info != 0) throw std::runtime_error("dstevd failed with info " + std::to_string(info));
  modes.vectors = width.cwiseSqrt().cwiseInverse().asDiagonal() * modes.vectors;
  if (conductance_low == 0.0 && conductance_high == 0.0) {
    modes.values[0] = 0.0;
    modes.vectors.col(0).setConstant(1.0 / std::sqrt(width.sum()));
  }
  return modes;
}

}  // namespace

AxisModes::AxisModes(const Axis& axis, bool open_ends) : n_(axis.n()) {
  const Eigen::Map<const Eigen::VectorXd> width(axis.width.data(), n_);
  const double low = open_ends ? 1.0 / axis.gap.front() : 0.0;
  const double high = open_ends ? 1.0 / axis.gap.back() : 0.0;
  if (!isSymmetric(axis)) {
    classes_.push_back(tridiagonalModes(width, low, high));
    return;
  }
  const Eigen::VectorXd half = 0.5 * (width.head(n_ / 2) + width.tail(n_ / 2).reverse());
  classes_.push_back(tridiagonalModes(half, low, 0.0));                     // even: no flux
  classes_.push_back(tridiagonalModes(half, low, 2.0 / half[n_ / 2 - 1]));  // odd: p = 0
  for (ModeClass& modes : classes_) modes.vectors *= std::sqrt(0.5);
}

Eigen::MatrixXd AxisModes::rows(int first, int count) const {
  Eigen::MatrixXd all(count, n_);
  int column = 0;
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    const Eigen::MatrixXd& vectors = classes_[c].vectors;
    const int m = classes_[c].m();
    for (int r = 0; r < count; ++r) {
      const int i = first + r;
      const double mirror = c == 0 ? 1.0 : -1.0;
      if (i < m) {
        all.row(r).segment(column, m) = vectors.row(i);
      } else {
        all.row(r).segment(column, m) = mirror * vectors.row(n_ - 1 - i);
      }
    }
    column += m;
  }
  return all;
}

}  // namespace monarch_flight::fluid::pressure
