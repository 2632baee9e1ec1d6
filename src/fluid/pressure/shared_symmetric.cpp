#include "fluid/pressure/shared_symmetric.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {
namespace {

constexpr int kColumns = 16;  // of B at a time, so that its second use finds it in the cache
constexpr int kShares = 8;

/// y += [A, B^T; B, 0] x: columns [begin, end) of a symmetric matrix and what mirrors them.
void addColumns(const double* matrix, int n, int begin, int end, const double* x, double* y) {
  auto column = [&](int c) { return matrix + static_cast<std::ptrdiff_t>(c) * n; };
  cblas_dsymv(CblasColMajor, CblasLower, end - begin, 1.0, column(begin) + begin, n, x + begin, 1,
              1.0, y + begin, 1);
  for (int c = begin; c < end; c += kColumns) {
    const int columns = std::min(kColumns, end - c), rows = n - end;
    const double* b = column(c) + end;
    cblas_dgemv(CblasColMajor, CblasNoTrans, rows, columns, 1.0, b, n, x + c, 1, 1.0, y + end, 1);
    cblas_dgemv(CblasColMajor, CblasTrans, rows, columns, 1.0, b, n, x + end, 1, 1.0, y + c, 1);
  }
}

}  // namespace

SharedSymmetric::SharedSymmetric(Eigen::MatrixXd matrix, const Slab& slab, int k, const Team& team)
    : slab_(slab), team_(team), n_(static_cast<int>(matrix.rows())) {
  if (slab.k1() == k) part_ = Part::kBelow;
  if (slab.k0() == k) part_ = Part::kAbove;
  if (part_ == Part::kAll) {
    held_ = std::move(matrix);
    for (int share = 1; share <= kShares; ++share)  // of the triangle, all alike
      ends_.push_back(n_ - static_cast<int>(n_ * std::sqrt(1 - share / double(kShares))));
    sums_.setZero(n_, kShares);
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
    multiplyAll(x, y);
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

void SharedSymmetric::multiplyAll(const double* x, double* y) const {
  team_.each(0, kShares, [&](int share, int) {
    double* sum = sums_.col(share).data();
    std::fill_n(sum, n_, 0.0);
    addColumns(held_.data(), n_, share == 0 ? 0 : ends_[share - 1], ends_[share], x, sum);
  });
  std::copy_n(sums_.data(), n_, y);
  for (int share = 1; share < kShares; ++share) {
    const double* sum = sums_.col(share).data();
    for (int i = 0; i < n_; ++i) y[i] += sum[i];
  }
}

void SharedSymmetric::multiplyBelow(const double* x, double* y) const {
  std::fill_n(y, n_, 0.0);
  addColumns(held_.data(), n_, 0, split_, x, y);
}

}  // namespace monarch_flight::fluid::pressure
