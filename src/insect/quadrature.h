#pragma once
#include <array>

namespace monarch_flight {

/// Nodes and weights of the Gauss-Legendre rule on [-1, 1], exact for polynomials of degree 2 N
/// - 1.
template <int N>
struct GaussLegendre {
  std::array<double, N> node{};
  std::array<double, N> weight{};
};

/// The rule that all integrals over the span use, computed once.
constexpr int kSpanNodes = 32;
const GaussLegendre<kSpanNodes>& spanRule();

}  // namespace monarch_flight
