#include "monarch_flight/fluid/grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr double kRatioAtWing = 1.08;  // largest stretching within kNearWing mean chords
constexpr double kNearWing = 0.3;      // [mean chords]
constexpr double kRatioStep = 0.03;    // the ratio grows by so much from cell to cell
constexpr long kMaxCells = 200000000;  // beyond: surely a slip in the settings
constexpr long kMaxWingFaces = 40000;  // capacitance matrix: 4.8 n^2 bytes = 7.7 GB
constexpr double kFewestCellsAcross = 4;

/// Cell widths that begin with `first`: within `near` they grow by at most kRatioAtWing, beyond it
/// the ratio itself rises smoothly to `growth`.
struct Stretching {
  double first, near, ratio_at_start, growth;

  /// Calls visit(width) cell by cell until it returns false.
  template <class Visit>
  void walk(Visit visit) const {
    double width = first, ratio = std::min(ratio_at_start, growth), height = 0.0;
    while (visit(width)) {
      height += width;
      if (height >= near) ratio = std::min(growth, ratio + kRatioStep);
      width *= ratio;
    }
  }
  double length(int n) const {
    double sum = 0.0;
    walk([&](double width) { return n-- > 0 ? (sum += width, true) : false; });
    return sum;
  }
};

/// Offsets of the faces from the wing (or the uniform region): 0, ..., exactly `total`, in the
/// fewest cells that `stretching` allows; its growth is lowered until the last face falls on
/// `total`.
std::vector<double> stretchedOffsets(Stretching stretching, double total) {
  int n = 0;
  double sum = 0.0;
  stretching.walk([&](double width) {
    if (sum >= total * (1.0 - 1e-12)) return false;
    sum += width;
    return ++n < kMaxCells;
  });
  double low = 1.0, high = stretching.growth;
  for (int it = 0; it < 100; ++it) {
    stretching.growth = 0.5 * (low + high);
    (stretching.length(n) > total ? high : low) = stretching.growth;
  }
  std::vector<double> offset{0.0};
  stretching.walk([&](double width) {
    offset.push_back(offset.back() + width);
    return static_cast<int>(offset.size()) <= n;
  });
  const double scale = total / offset.back();  // 1 up to rounding, or a uniform run of n cells
  for (double& o : offset) o *= scale;
  return offset;
}

/// How many cells planeFaces puts across a box of this length and its margins.
double uniformCells(double length, double spacing, double margin) {
  const double half = std::max(1.0, std::round(0.5 * length / spacing));
  return 2.0 * (half + std::ceil(margin * half / (0.5 * length)));
}

/// Faces symmetric about (low + high) / 2, uniform over [low, high] (an even number of cells, faces
/// on both ends) and at least `margin` around it, stretched beyond up to `far` from the box.
std::vector<double> planeFaces(double low, double high, double spacing, double margin, double far,
                               double growth) {
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * (high - low) / spacing)));
  const double h = 0.5 * (high - low) / half;
  const int around = static_cast<int>(std::ceil(margin / h - 1e-9));
  std::vector<double> offset;  // from the box centre, one side
  for (int i = 0; i <= half + around; ++i) offset.push_back(i * h);
  const double rest = far - around * h;
  if (rest > 0.0) {
    const double ratio = 1.0 + kRatioStep;
    const auto outside = stretchedOffsets({h * std::min(ratio, growth), 0.0, ratio, growth}, rest);
    const double start = offset.back();
    for (std::size_t i = 1; i < outside.size(); ++i) offset.push_back(start + outside[i]);
  }
  const double centre = 0.5 * (low + high);
  std::vector<double> faces;
  for (std::size_t i = offset.size() - 1; i > 0; --i) faces.push_back(centre - offset[i]);
  for (double o : offset) faces.push_back(centre + o);
  return faces;
}

std::vector<double> normalFaces(double first, double near, double far, double growth) {
  const auto offset = stretchedOffsets({first, near, kRatioAtWing, growth}, far);
  std::vector<double> faces;
  for (std::size_t k = offset.size() - 1; k > 0; --k) faces.push_back(-offset[k]);
  faces.insert(faces.end(), offset.begin(), offset.end());
  return faces;
}

double meanOver(double low, double high, const std::function<double(double)>& edge) {
  constexpr int kSamples = 32;
  double sum = 0.0;
  for (int s = 0; s < kSamples; ++s) sum += edge(low + (high - low) * (s + 0.5) / kSamples);
  return sum / kSamples;
}

double nearestFace(const Axis& axis, double position) {
  auto at = std::lower_bound(axis.face.begin(), axis.face.end(), position);
  if (at == axis.face.end()) return axis.face.back();
  return at != axis.face.begin() && position - at[-1] < *at - position ? at[-1] : *at;
}

/// Staircase outline. In each row the edges lie at the faces nearest to their means; what that
/// rounds off is carried to the next row, from mid span outwards. So the area and its moments, on
/// which the added mass depends, are those of the outline but for a cell here and there, where
/// rounding each row alone widens the wing wherever an edge touches the box.
std::vector<std::uint8_t> staircase(const Planform& planform, const Axis& x, const Axis& y) {
  std::vector<std::uint8_t> wing(static_cast<std::size_t>(x.n()) * y.n(), 0);
  const double middle = 0.5 * (planform.yRoot() + planform.yTip());
  double carried_lead = 0.0, carried_trail = 0.0;
  auto place = [&](int j) {
    const double low = std::max(y.face[j], planform.yRoot());
    const double high = std::min(y.face[j + 1], planform.yTip());
    auto rounded = [&](double mean, double& carried) {
      const double face = nearestFace(x, mean + carried);
      carried += mean - face;
      return face;
    };
    const double lead =
        rounded(meanOver(low, high, [&](double s) { return planform.leading(s); }), carried_lead);
    const double trail =
        rounded(meanOver(low, high, [&](double s) { return planform.trailing(s); }), carried_trail);
    for (int i = 0; i < x.n(); ++i) {
      wing[static_cast<std::size_t>(j) * x.n() + i] = x.centre[i] > trail && x.centre[i] < lead;
    }
  };
  const int begin = static_cast<int>(std::lower_bound(y.centre.begin(), y.centre.end(), middle) -
                                     y.centre.begin());
  for (int j = begin; j < y.n() && y.centre[j] < planform.yTip(); ++j) place(j);
  carried_lead = carried_trail = 0.0;
  for (int j = begin - 1; j >= 0 && y.centre[j] > planform.yRoot(); --j) place(j);
  return wing;
}

void requireResolved(const Planform& planform, const GridSettings& settings, const Grid& grid) {
  const long faces = std::count(grid.wing.begin(), grid.wing.end(), std::uint8_t{1});
  const double rows = planform.span() * settings.cells_per_chord / planform.meanChord();
  const double across_chord = faces / std::max(rows, 1.0);
  std::vector<std::string> faults;
  auto check = [&](double cells, const char* what) {
    if (cells >= kFewestCellsAcross - 0.5) return;  // half a cell for the rounding to whole cells
    std::ostringstream text;
    text << "grid/cells_per_chord = " << settings.cells_per_chord << ": the wing gets " << cells
         << " cells across its " << what << ", must be >= " << kFewestCellsAcross
         << "; raise cells_per_chord";
    faults.push_back(text.str());
  };
  check(across_chord, "mean chord");
  check(rows, "span");
  if (faces > kMaxWingFaces) {
    std::ostringstream text;
    text << "grid/cells_per_chord = " << settings.cells_per_chord << ": the wing gets " << faces
         << " faces, must be <= " << kMaxWingFaces << "; lower cells_per_chord";
    faults.push_back(text.str());
  }
  if (!faults.empty()) throw InputError(faults);
}

/// Refuses absurd settings before anything of the grid's size is allocated.
void requireAffordable(double nx, double ny, double nz) {
  if (nx * ny * nz <= static_cast<double>(kMaxCells)) return;
  std::ostringstream text;
  text << "grid: the settings ask for " << nx << " x " << ny << " x " << nz
       << " cells, must be <= " << kMaxCells
       << " in all; lower cells_per_chord or far_field, or raise first_cell or the growth ratios";
  throw InputError(text.str());
}

}  // namespace

Axis Axis::fromFaces(std::vector<double> faces) {
  const int n = static_cast<int>(faces.size()) - 1;
  if (n < 1) throw std::invalid_argument("Axis::fromFaces: needs at least two faces");
  Axis axis;
  axis.centre.resize(n);
  axis.width.resize(n);
  axis.gap.resize(n + 1);
  for (int i = 0; i < n; ++i) {
    axis.width[i] = faces[i + 1] - faces[i];
    if (!(axis.width[i] > 0.0)) {
      throw std::invalid_argument("Axis::fromFaces: faces must increase strictly");
    }
    axis.centre[i] = 0.5 * (faces[i] + faces[i + 1]);
  }
  for (int i = 1; i < n; ++i) axis.gap[i] = 0.5 * (axis.width[i - 1] + axis.width[i]);
  axis.gap[0] = 0.5 * axis.width[0];
  axis.gap[n] = 0.5 * axis.width[n - 1];
  axis.face = std::move(faces);
  return axis;
}

Grid makeGrid(Axis x, Axis y, Axis z, int k_wing, bool open, std::vector<std::uint8_t> wing) {
  if (k_wing < 1 || k_wing > z.n() - 1) {
    throw std::invalid_argument("makeGrid: cells must lie on both sides of the wing's plane");
  }
  if (std::abs(z.face[k_wing]) > 1e-12 * std::min(z.width[k_wing - 1], z.width[k_wing])) {
    throw std::invalid_argument("makeGrid: the wing's plane must be z = 0");
  }
  if (wing.size() != static_cast<std::size_t>(x.n()) * y.n()) {
    throw std::invalid_argument("makeGrid: the wing's mask must have nx * ny entries");
  }
  Mobility mobility(x, y, z, k_wing, wing);
  return Grid{std::move(x), std::move(y),    std::move(z),       k_wing,
              open,         std::move(wing), std::move(mobility)};
}

Grid makeGrid(const Planform& planform, const GridSettings& settings) {
  const auto faults = settings.problems();
  if (!faults.empty()) throw InputError(faults);
  const double chord = planform.meanChord();
  const double spacing = chord / settings.cells_per_chord;
  const double margin = settings.margin * chord, far = settings.far_field * chord;
  requireAffordable(uniformCells(planform.xMax() - planform.xMin(), spacing, margin),
                    uniformCells(planform.span(), spacing, margin), 1.0);

  auto x =
      planeFaces(planform.xMin(), planform.xMax(), spacing, margin, far, settings.growth_plane);
  auto y =
      planeFaces(planform.yRoot(), planform.yTip(), spacing, margin, far, settings.growth_plane);
  auto z = normalFaces(settings.first_cell * chord, kNearWing * chord, far, settings.growth_normal);
  requireAffordable(x.size() - 1.0, y.size() - 1.0, z.size() - 1.0);

  Axis ax = Axis::fromFaces(std::move(x)), ay = Axis::fromFaces(std::move(y));
  Axis az = Axis::fromFaces(std::move(z));
  auto wing = staircase(planform, ax, ay);
  const int k_wing = az.n() / 2;
  Grid grid = makeGrid(std::move(ax), std::move(ay), std::move(az), k_wing,
                       settings.outer == "open", std::move(wing));
  requireResolved(planform, settings, grid);
  return grid;
}

}  // namespace monarch_flight
