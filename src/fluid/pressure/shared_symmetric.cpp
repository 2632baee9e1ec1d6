#include "fluid/pressure/shared_symmetric.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {
namespace {

constexpr int kCached = 16;  // columns at a time, so that their second use finds them in the cache

/// y += a panel, and what mirrors it, times x.
void addPanel(const SymmetricTiles& matrix, int tile, const double* x, double* y) {
  const int begin = matrix.first(tile), end = begin + matrix.width(tile);
  const int rows = matrix.rows() - end, leading = matrix.leading(tile);
  cblas_dsymv(CblasColMajor, CblasLower, end - begin, 1.0, matrix.tile(tile, tile), leading,
              x + begin, 1, 1.0, y + begin, 1);
  if (rows == 0) return;
  for (int c = begin; c < end; c += kCached) {
    const int columns = std::min(kCached, end - c);
    const double* b =
        matrix.tile(tile + 1, tile) + static_cast<std::ptrdiff_t>(c - begin) * leading;
    cblas_dgemv(CblasColMajor, CblasNoTrans, rows, columns, 1.0, b, leading, x + c, 1, 1.0, y + end,
                1);
    cblas_dgemv(CblasColMajor, CblasTrans, rows, columns, 1.0, b, leading, x + end, 1, 1.0, y + c,
                1);
  }
}

}  // namespace

SharedSymmetric::SharedSymmetric(SymmetricTiles matrix, const Slab& slab, int k, const Team& team)
    : slab_(slab), team_(team), matrix_(std::move(matrix)), end_(matrix_.panels()) {
  if (slab.k1() == k) part_ = Part::kBelow;
  if (slab.k0() == k) part_ = Part::kAbove;
  if (part_ != Part::kAll) {
    int half = 0;  // of the triangle
    while (matrix_.first(half) < matrix_.rows() * (1 - std::sqrt(0.5)) - 1) ++half;
    (part_ == Part::kBelow ? end_ : begin_) = half;
    matrix_.keep(begin_, end_);
    partner_.setZero(matrix_.rows());
  }
  sums_.setZero(matrix_.rows(), end_ - begin_);
}

void SharedSymmetric::multiply(const double* x, double* y) const {
  const int n = matrix_.rows();
  team_.each(begin_, end_, [&](int tile, int) {
    double* sum = sums_.col(tile - begin_).data();
    std::fill_n(sum, n, 0.0);
    addPanel(matrix_, tile, x, sum);
  });
  std::fill_n(y, n, 0.0);
  for (int column = 0; column < end_ - begin_; ++column) {
    const double* sum = sums_.col(column).data();
    for (int i = 0; i < n; ++i) y[i] += sum[i];
  }
  if (part_ == Part::kAll) return;
  part_ == Part::kBelow ? slab_.exchangeAbove(y, partner_.data(), n)
                        : slab_.exchangeBelow(y, partner_.data(), n);
  for (int i = 0; i < n; ++i) y[i] += partner_[i];
}

}  // namespace monarch_flight::fluid::pressure
