#include "monarch_flight/viz/wing_sheet.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {
namespace {

using Facet = SurfacePressure::Facet;

Eigen::Vector4f placeOf(const Facet& f) { return {f.x, f.y, f.dx, f.dy}; }

/// Squared distance from a facet's centre, in sizes of the facet.
double distance(const Facet& f, const Eigen::Vector2d& point) {
  const double x = (point.x() - f.x) / f.dx, y = (point.y() - f.y) / f.dy;
  return x * x + y * y;
}

}  // namespace

WingSheet::WingSheet(const Planform& planform, int rows, int columns)
    : rows_(rows), columns_(columns) {
  for (int i = 0; i < rows; ++i) {
    // Cosine spacing: the outline turns fastest at root and tip.
    const double s = 0.5 * (1.0 - std::cos(M_PI * i / (rows - 1)));
    const double y = planform.yRoot() + s * planform.span();
    const double trailing = planform.trailing(y), chord = planform.leading(y) - trailing;
    for (int j = 0; j < columns; ++j) points_.emplace_back(trailing + chord * j / (columns - 1), y);
  }
}

FacetMeans::FacetMeans(const SurfacePressure& surface, const std::vector<Eigen::Vector2d>& points) {
  constexpr double kWidth = 0.75, kReach = 2.0;  // sizes of a facet
  for (const Facet& f : surface.facets) facets_.push_back(placeOf(f));
  for (const Eigen::Vector2d& point : points) {
    Weights near;
    std::size_t nearest = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < surface.facets.size(); ++i) {
      const double d = distance(surface.facets[i], point);
      if (d < distance(surface.facets[nearest], point)) nearest = i;
      if (d > kReach * kReach) continue;
      near.emplace_back(i, std::exp(-0.5 * d / (kWidth * kWidth)));
      sum += near.back().second;
    }
    if (near.empty() && !facets_.empty()) near = {{nearest, sum = 1.0}};  // beyond the staircase
    for (auto& [facet, weight] : near) weight /= sum;
    weights_.push_back(std::move(near));
  }
}

bool FacetMeans::fits(const SurfacePressure& surface) const {
  return std::equal(
      surface.facets.begin(), surface.facets.end(), facets_.begin(), facets_.end(),
      [](const Facet& f, const Eigen::Vector4f& place) { return placeOf(f) == place; });
}

std::vector<double> FacetMeans::of(const SurfacePressure& surface, float Facet::*side) const {
  std::vector<double> out;
  for (const Weights& near : weights_) {
    double p = 0.0;
    for (const auto& [facet, weight] : near) p += weight * double(surface.facets[facet].*side);
    out.push_back(p);
  }
  return out;
}

}  // namespace monarch_flight
