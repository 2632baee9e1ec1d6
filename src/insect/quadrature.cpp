#include "insect/quadrature.h"

#include <cmath>

namespace monarch_flight {
namespace {

/// Value and derivative of the Legendre polynomial of degree n at x (three-term recurrence).
std::array<double, 2> legendre(int n, double x) {
  double previous = 1.0;
  double value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (x * value - previous) / (x * x - 1.0)};
}

template <int N>
GaussLegendre<N> makeRule() {
  GaussLegendre<N> rule;
  for (int i = 0; i < N; ++i) {
    double x = -std::cos(M_PI * (i + 0.75) / (N + 0.5));
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto [p, dp] = legendre(N, x);
      x -= p / dp;
      if (std::abs(p / dp) < 1e-16) break;
    }
    const double dp = legendre(N, x)[1];
    rule.node[i] = x;
    rule.weight[i] = 2.0 / ((1.0 - x * x) * dp * dp);
  }
  return rule;
}

}  // namespace

const GaussLegendre<kSpanNodes>& spanRule() {
  static const GaussLegendre<kSpanNodes> rule = makeRule<kSpanNodes>();
  return rule;
}

}  // namespace monarch_flight
