#include "fluid/pressure/shared_symmetric.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {
namespace {
constexpr int kColumns = 16;  // of B at a time, so that its second use finds it in the cache
}

SharedSymmetric::SharedSymmetric(Eigen::MatrixXd matrix, const Slab& slab, int k)
    : slab_(slab), n_(static_cast<int>(matrix.rows())) {
  if (slab.k1() == k) part_ = Part::kBelow;
  if (slab.k0() == k) part_ = Part::kAbove;
  if (part_ == Part::kAll) {
    held_ = std::move(matrix);
    return;
  }
  split_ = static_cast<int>(std::lround(n_ * (1 - std::sqrt(0.5))));  // halves of the triangle
  const int rest = n_ - split_, kept = part_ == Part::kBelow ? split_ : rest;
  double* columns = matrix.data();  // what is kept moves to the front, without a copy of the matrix
  if (part_ == Part::kAbove)
    std::copy(columns + static_cast<std::ptrdiff_t>(split_) * n_, columns + matrix.size(), columns);
  matrix.conservativeResize(n_, kept);
  held_ = std::move(matrix);
  partner_.setZero(n_);
}

void SharedSymmetric::multiply(const double* x, double* y) const {
  if (part_ == Part::kAll) {
    cblas_dsymv(CblasColMajor, CblasLower, n_, 1.0, held_.data(), n_, x, 1, 0.0, y, 1);
    return;
  }
  if (part_ == Part::kBelow) {
    multiplyBelow(x, y);
    slab_.exchangeAbove(y, partner_.data(), n_);
  } else {
    const int rest = n_ - split_;
    std::fill_n(y, split_, 0.0);
    cblas_dsymv(CblasColMajor, CblasLower, rest, 1.0, held_.data() + split_, n_, x + split_, 1, 0.0,
                y + split_, 1);
    slab_.exchangeBelow(y, partner_.data(), n_);
  }
  for (int i = 0; i < n_; ++i) y[i] += partner_[i];
}

void SharedSymmetric::multiplyBelow(const double* x, double* y) const {
  cblas_dsymv(CblasColMajor, CblasLower, split_, 1.0, held_.data(), n_, x, 1, 0.0, y, 1);
  std::fill_n(y + split_, n_ - split_, 0.0);
  for (int column = 0; column < split_; column += kColumns) {
    const int columns = std::min(kColumns, split_ - column), rows = n_ - split_;
    const double* b = held_.data() + static_cast<std::ptrdiff_t>(column) * n_ + split_;
    cblas_dgemv(CblasColMajor, CblasNoTrans, rows, columns, 1.0, b, n_, x + column, 1, 1.0,
                y + split_, 1);
    cblas_dgemv(CblasColMajor, CblasTrans, rows, columns, 1.0, b, n_, x + split_, 1, 1.0,
                y + column, 1);
  }
}

}  // namespace monarch_flight::fluid::pressure
