// The block of points around the wing that pictures are made of: sampled from the cells, in whole
// numbers.
#include <algorithm>
#include <cmath>

#include "fluid/fields/gathered.h"
#include "fluid/flow/derived.h"
#include "fluid/flow/flow.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {

FlowPicture mirrored(const FlowPicture& block) {
  FlowPicture out = block;
  const std::size_t nx = block.size[0], ny = block.size[1], nz = block.size[2];
  for (std::size_t row = 0; row < ny * nz; ++row) {
    const std::size_t j = row % ny;
    const auto from = static_cast<std::ptrdiff_t>((row - j + ny - 1 - j) * nx);
    const auto to = static_cast<std::ptrdiff_t>(row * nx), n = static_cast<std::ptrdiff_t>(nx);
    std::copy_n(block.q_root.begin() + from, n, out.q_root.begin() + to);
    std::copy_n(block.omega_y.begin() + from, n, out.omega_y.begin() + to);
  }
  out.origin[1] = 0.0f - (block.origin[1] + static_cast<float>(ny - 1) * block.spacing);
  return out;
}

namespace fluid {
namespace {

// How far the block reaches beyond the wing [mean chords]: within that the wake of half a flap is
// strong, farther out the grid is coarse.
constexpr double kBesideWing = 0.7, kAboveWing = 1.2;
constexpr double kLargest = 32767.0;  // of the numbers that a point is told in

/// Where the block's points lie along one axis among the cells: between the centres of `cell` and
/// of the next one, `share` of the way.
struct Samples {
  double first = 0.0;
  std::vector<int> cell;
  std::vector<double> share;
  int size() const { return static_cast<int>(cell.size()); }
  int begin() const { return cell.front(); }   ///< first cell that is looked at
  int end() const { return cell.back() + 2; }  ///< behind the last one
};

struct Interval {
  double low, high;
  double length() const { return high - low; }
};

/// The part of [low, high] in which cells with neighbours on all sides lie.
Interval inside(const Axis& axis, double low, double high) {
  const auto n = static_cast<std::size_t>(axis.n());
  return {std::max(low, axis.centre[1]), std::min(high, axis.centre[n - 2])};
}

/// Of the wing's faces, with what the block reaches beyond them.
std::array<Interval, 3> extent(const Grid& grid, double chord) {
  Interval x{grid.x.face.back(), grid.x.face.front()}, y{grid.y.face.back(), grid.y.face.front()};
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      if (!grid.isWing(i, j)) continue;
      x = {std::min(x.low, grid.x.face[i]), std::max(x.high, grid.x.face[i + 1])};
      y = {std::min(y.low, grid.y.face[j]), std::max(y.high, grid.y.face[j + 1])};
    }
  }
  if (x.low > x.high) x = y = {0.0, 0.0};  // no wing
  const double beside = kBesideWing * chord, above = kAboveWing * chord;
  return {inside(grid.x, x.low - beside, x.high + beside),
          inside(grid.y, y.low - beside, y.high + beside), inside(grid.z, -above, above)};
}

using Counts = std::array<int, 3>;

/// Points along each axis. Along z they are even in number, so that none lies in the wing.
Counts countsFor(const std::array<Interval, 3>& box, double spacing) {
  const double half = std::min(-box[2].low, box[2].high);
  return {std::max(2, static_cast<int>(box[0].length() / spacing) + 1),
          std::max(2, static_cast<int>(box[1].length() / spacing) + 1),
          2 * std::max(1, static_cast<int>(half / spacing + 0.5))};
}

/// That of the cells beside the wing, or larger, so that there are no more than `limit` points.
double spacingFor(const std::array<Interval, 3>& box, const Grid& grid, std::size_t limit) {
  double h = std::min(*std::min_element(grid.x.width.begin(), grid.x.width.end()),
                      *std::min_element(grid.y.width.begin(), grid.y.width.end()));
  const auto points = [&] {
    const Counts n = countsFor(box, h);
    return static_cast<double>(n[0]) * n[1] * n[2];
  };
  const double longest = std::max({box[0].length(), box[1].length(), box[2].length()});
  while (points() > static_cast<double>(limit) && h < longest) h *= 1.02;
  return h;
}

/// In the middle of `part`.
Samples samplesAlong(const Axis& axis, const Interval& part, int n, double spacing) {
  Samples s;
  s.first = 0.5 * (part.low + part.high - (n - 1) * spacing);
  int cell = 0;
  for (int i = 0; i < n; ++i) {
    const double at = s.first + i * spacing;
    while (cell + 2 < axis.n() && axis.centre[cell + 1] <= at) ++cell;
    s.cell.push_back(cell);
    s.share.push_back(std::clamp((at - axis.centre[cell]) / axis.gap[cell + 1], 0.0, 1.0));
  }
  return s;
}

double signedRoot(double q) { return std::copysign(std::sqrt(std::abs(q)), q); }

/// Where the block has its points.
struct Points {
  double spacing;
  Samples x, y, z;
  Points(const Grid& grid, double chord, std::size_t limit) {
    const std::array<Interval, 3> box = extent(grid, chord);
    spacing = spacingFor(box, grid, limit);
    const Counts n = countsFor(box, spacing);
    x = samplesAlong(grid.x, box[0], n[0], spacing);
    y = samplesAlong(grid.y, box[1], n[1], spacing);
    z = samplesAlong(grid.z, {0.0, 0.0}, n[2], spacing);
  }
  std::size_t plane() const { return static_cast<std::size_t>(x.size()) * y.size(); }
};

/// Two numbers a point: signed root of Q, vorticity along the span.
using Pairs = std::vector<std::array<float, 2>>;

/// Bilinear, from the cells (x.begin() .. x.end()) x (y.begin() .. y.end()).
void sample(const Samples& x, const Samples& y, const Pairs& cells, std::array<float, 2>* out) {
  const auto at = [&](int i, int j) -> const std::array<float, 2>& {
    return cells[static_cast<std::size_t>(j - y.begin()) * (x.end() - x.begin()) + i - x.begin()];
  };
  for (int j = 0; j < y.size(); ++j) {
    for (int i = 0; i < x.size(); ++i, ++out) {
      const int a = x.cell[i], b = y.cell[j];
      const double s = x.share[i], t = y.share[j];
      for (std::size_t f = 0; f < 2; ++f) {
        const double low = (1 - s) * at(a, b)[f] + s * at(a + 1, b)[f];
        const double high = (1 - s) * at(a, b + 1)[f] + s * at(a + 1, b + 1)[f];
        (*out)[f] = static_cast<float>((1 - t) * low + t * high);
      }
    }
  }
}

/// Linear along z, from planes of the cells z.begin() .. z.end().
Pairs between(const Samples& z, const Pairs& planes, std::size_t plane) {
  Pairs out;
  out.reserve(plane * z.size());
  for (int k = 0; k < z.size(); ++k) {
    const auto* low = planes.data() + static_cast<std::size_t>(z.cell[k] - z.begin()) * plane;
    const auto* high = low + plane;
    const auto t = static_cast<float>(z.share[k]);
    for (std::size_t p = 0; p < plane; ++p) {
      out.push_back(
          {low[p][0] + t * (high[p][0] - low[p][0]), low[p][1] + t * (high[p][1] - low[p][1])});
    }
  }
  return out;
}

void fill(const Pairs& values, FlowPicture& block) {
  float largest = 0.0f;
  bool finite = true;
  for (const auto& value : values) {
    largest = std::max({largest, std::abs(value[0]), std::abs(value[1])});
    finite = finite && std::isfinite(value[0]) && std::isfinite(value[1]);
  }
  if (!finite) throw NumericalError("Navier-Stokes: the flow around the wing is not finite");
  block.step = static_cast<float>(largest / kLargest);
  const double by = block.step > 0.0f ? 1.0 / block.step : 0.0;
  const auto whole = [by](float value) {
    return static_cast<std::int16_t>(std::clamp(std::round(by * value), -kLargest, kLargest));
  };
  block.q_root.reserve(values.size());
  block.omega_y.reserve(values.size());
  for (const auto& value : values) {
    block.q_root.push_back(whole(value[0]));
    block.omega_y.push_back(whole(value[1]));
  }
}

}  // namespace

FlowPicture NavierStokes::flowPicture(std::size_t limit) const {
  requireCommitted();
  const Points points(grid_, reference_length_, limit);
  const Samples &x = points.x, &y = points.y, &z = points.z;
  const int k0 = std::max(z.begin(), layout_.k0), k1 = std::min(z.end(), layout_.k1);
  Pairs mine(points.plane() * static_cast<std::size_t>(std::max(0, k1 - k0)));
  team_.each(k0, k1, [&](int k, int) {
    Pairs cells;
    for (int j = y.begin(); j < y.end(); ++j) {
      for (int i = x.begin(); i < x.end(); ++i) {
        const Eigen::Matrix3d g = gradientAt(i, j, k);
        cells.push_back({float(signedRoot(secondInvariant(g))), float(curl(g).y())});
      }
    }
    sample(x, y, cells, mine.data() + static_cast<std::size_t>(k - k0) * points.plane());
  });
  const Pairs planes = gathered(slab_, mine);
  FlowPicture block;
  if (!slab_.atBottom()) return block;
  block.origin = {float(x.first), float(y.first), float(z.first)};
  block.spacing = static_cast<float>(points.spacing);
  block.size = {std::uint32_t(x.size()), std::uint32_t(y.size()), std::uint32_t(z.size())};
  fill(between(z, planes, points.plane()), block);
  return block;
}

}  // namespace fluid
}  // namespace monarch_flight
