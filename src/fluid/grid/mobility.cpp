#include "monarch_flight/fluid/mobility.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/fluid/grid.h"

namespace monarch_flight {
namespace {

/// The faces farther from the rim miss a little of the gradient, too. The nearest ones make up for
/// it: by this factor the added mass of the two-dimensional plate, 24 to 96 cells wide, heaving or
/// turning, is right to 0.1 % and 1.8 % (24 cells) and 0.1 % and 0.4 % (48), aspects 0.28 to 1.
constexpr double kNeighbours = 1.08;

}  // namespace

// With the rim at the origin, the wing at x < 0 and cells of width 1: the centre of the first cell
// outside is at (1/2, aspect/2), that of the last one on the wing at (-1/2, aspect/2).
double Mobility::besideRim(double aspect) {
  const double r = 0.5 * std::hypot(1, aspect), theta = std::atan(aspect);
  const double quotient = std::sqrt(r) * std::sin(0.5 * theta) / (0.5 * aspect);
  return kNeighbours / quotient;  // mean of 1 / (2 sqrt(x)) over 0 < x < 1 is 1
}

double Mobility::acrossRim(double aspect) {
  const double r = 0.5 * std::hypot(1, aspect), theta = std::atan(aspect);
  const double quotient = std::sqrt(r) * (std::cos(0.5 * theta) - std::sin(0.5 * theta));
  return kNeighbours / std::sqrt(2 * aspect) /
         quotient;  // mean of 1 / (2 sqrt(2 z)) over 0 < z < aspect
}

Mobility::Mobility(const Axis& x, const Axis& y, const Axis& z, int k_wing,
                   const std::vector<std::uint8_t>& wing)
    : empty_(std::find(wing.begin(), wing.end(), 1) == wing.end()), nx_(x.n()), k_wing_(k_wing) {
  if (empty_) return;
  const int ny = y.n();
  auto is_wing = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < nx_ && j < ny && wing[static_cast<std::size_t>(j) * nx_ + i];
  };
  normal_.assign(wing.size(), 1.0);
  for (auto& component : in_plane_) component[0] = component[1] = normal_;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx_; ++i) {
      const std::size_t q = static_cast<std::size_t>(j) * nx_ + i;
      const double height = z.gap[k_wing];
      if (is_wing(i, j)) {
        normal_[q] = 0;
      } else {
        if (is_wing(i - 1, j) || is_wing(i + 1, j)) normal_[q] = besideRim(height / x.width[i]);
        if (is_wing(i, j - 1) || is_wing(i, j + 1))
          normal_[q] = std::max(normal_[q], besideRim(height / y.width[j]));
      }
      for (int side : {0, 1}) {
        const double width = z.width[k_wing - 1 + side];
        if (i > 0 && is_wing(i, j) != is_wing(i - 1, j))
          in_plane_[0][side][q] = acrossRim(width / x.gap[i]);
        if (j > 0 && is_wing(i, j) != is_wing(i, j - 1))
          in_plane_[1][side][q] = acrossRim(width / y.gap[j]);
      }
    }
  }
}

}  // namespace monarch_flight
