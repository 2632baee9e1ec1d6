#include "insect/smooth_spline.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <stdexcept>

namespace monarch_flight {

SmoothSpline::SmoothSpline(const std::vector<double>& t, const Eigen::MatrixXd& samples) {
  const int n = static_cast<int>(t.size());
  if (n < kLeastSamples || samples.cols() != n) {
    throw std::invalid_argument("a spline of degree 5 needs at least 6 samples, one a time");
  }
  // Interior knots are the samples but three at each end: as many basis functions as samples.
  constexpr int kDropped = (kDegree + 1) / 2;
  knots_.assign(kDegree + 1, t.front());
  for (int i = kDropped; i < n - kDropped; ++i) knots_.push_back(t[i]);
  knots_.insert(knots_.end(), kDegree + 1, t.back());

  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n) * (kDegree + 1));
  for (int i = 0; i < n; ++i) {
    const int span = spanOf(t[i]);
    const Basis b = basis(span, t[i]);
    for (int k = 0; k <= kDegree; ++k) entries.emplace_back(i, span - kDegree + k, b(0, k));
  }
  Eigen::SparseMatrix<double> collocation(n, n);
  collocation.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(collocation);
  if (solver.info() != Eigen::Success) throw std::invalid_argument("spline samples are degenerate");
  const Eigen::MatrixXd transposed = samples.transpose();
  control_ = solver.solve(transposed).transpose();
}

int SmoothSpline::spanOf(double t) const {
  const auto first = knots_.begin() + kDegree + 1;
  const auto last = knots_.end() - (kDegree + 1);
  return static_cast<int>(std::upper_bound(first, last, t) - knots_.begin()) - 1;
}

SmoothSpline::Basis SmoothSpline::basis(int span, double t) const {
  // Cox-de Boor triangle; the rows for degrees 3, 4, 5 are kept for the derivatives.
  std::array<std::array<double, kDegree + 2>, kDegree + 1> b{};  // b[p][k]: function span - p + k
  b[0][0] = 1.0;
  for (int p = 1; p <= kDegree; ++p) {
    for (int k = 0; k <= p; ++k) {
      const int i = span - p + k;  // function N_{i,p}
      double value = 0.0;
      if (k > 0) value += (t - knots_[i]) / (knots_[i + p] - knots_[i]) * b[p - 1][k - 1];
      if (k < p) {
        value += (knots_[i + p + 1] - t) / (knots_[i + p + 1] - knots_[i + 1]) * b[p - 1][k];
      }
      b[p][k] = value;
    }
  }
  // Derivative of degree p from values (or derivatives) of degree p - 1.
  const auto derived = [&](int p, const std::array<double, kDegree + 2>& lower) {
    std::array<double, kDegree + 2> result{};
    for (int k = 0; k <= p; ++k) {
      const int i = span - p + k;
      if (k > 0) result[k] += p / (knots_[i + p] - knots_[i]) * lower[k - 1];
      if (k < p) result[k] -= p / (knots_[i + p + 1] - knots_[i + 1]) * lower[k];
    }
    return result;
  };
  const auto first = derived(kDegree, b[kDegree - 1]);
  const auto second = derived(kDegree, derived(kDegree - 1, b[kDegree - 2]));
  Basis result;
  for (int k = 0; k <= kDegree; ++k) {
    result.col(k) << b[kDegree][k], first[k], second[k];
  }
  return result;
}

SmoothSpline::Value SmoothSpline::at(double t) const {
  const double inside = std::min(std::max(t, knots_.front()), knots_.back());
  const int span = spanOf(inside);
  const Basis b = basis(span, inside);
  const auto active = control_.middleCols(span - kDegree, kDegree + 1);
  return {active * b.row(0).transpose(), active * b.row(1).transpose(),
          active * b.row(2).transpose()};
}

}  // namespace monarch_flight
