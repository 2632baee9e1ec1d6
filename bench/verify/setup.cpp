#include "verify/setup.h"

#include <algorithm>
#include <limits>

namespace monarch_flight::verify {

Extrapolated extrapolate(const double h[3], const double f[3]) {
  const double ratio = (f[0] - f[1]) / (f[1] - f[2]);
  // (h0^p - h1^p) / (h1^p - h2^p) grows with p.
  auto of = [&](double p) {
    return (std::pow(h[0], p) - std::pow(h[1], p)) / (std::pow(h[1], p) - std::pow(h[2], p));
  };
  double order = std::numeric_limits<double>::quiet_NaN();
  if (ratio > of(0.05) && ratio < of(8)) {
    double low = 0.05, high = 8;
    for (int i = 0; i < 60; ++i) {
      order = 0.5 * (low + high);
      (of(order) > ratio ? high : low) = order;
    }
  }
  const double p = std::isnan(order) ? 1 : std::clamp(order, 0.5, 2.5);
  const double share = std::pow(h[2], p) / (std::pow(h[1], p) - std::pow(h[2], p));
  return {order, f[2] - share * (f[1] - f[2])};
}

}  // namespace monarch_flight::verify
