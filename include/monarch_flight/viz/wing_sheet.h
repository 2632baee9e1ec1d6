#pragma once
#include <utility>
#include <vector>

#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/planform.h"

namespace monarch_flight {

/// Points on a wing within its true outline, in rows along the chord: row i from the trailing edge
/// to the leading one.
class WingSheet {
 public:
  /// `rows` along the span and `columns` along the chord, each at least 2.
  WingSheet(const Planform& planform, int rows, int columns);
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const Eigen::Vector2d& at(int row, int column) const {
    return points_[static_cast<std::size_t>(row * columns_ + column)];
  }
  const std::vector<Eigen::Vector2d>& points() const { return points_; }

 private:
  int rows_, columns_;
  std::vector<Eigen::Vector2d> points_;  // x, y, wing axes [m]
};

/// Takes values of a wing's facets to points: a mean of the facets around, the near ones weighing
/// most (a Gaussian of about a facet's size), so that what was constant by facets becomes smooth.
class FacetMeans {
 public:
  FacetMeans(const SurfacePressure& surface, const std::vector<Eigen::Vector2d>& points);
  /// Whether it was made for facets at these places.
  bool fits(const SurfacePressure& surface) const;
  /// Pressure at every point, on the dorsal (p_upper) or ventral (p_lower) side [Pa].
  std::vector<double> of(const SurfacePressure& surface, float SurfacePressure::Facet::*side) const;

 private:
  using Weights = std::vector<std::pair<std::size_t, double>>;
  std::vector<Weights> weights_;  // of every point: facets and their shares, which add to 1
  std::vector<Eigen::Vector4f> facets_;
};

}  // namespace monarch_flight
