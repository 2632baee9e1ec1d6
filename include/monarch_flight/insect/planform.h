#pragma once
#include <functional>
#include <string>
#include <vector>

namespace monarch_flight {

/// Outline of one wing in its own plane, in wing axes: x towards the leading edge, y along the span
/// (root to tip for the right wing). The pitch hinge is the line x = 0; the root is the origin.
/// Immutable once built. Lengths in m.
class Planform {
 public:
  /// `leading(y) >= trailing(y)` for y in [y_root, y_tip]; `breaks` are interior stations where the
  /// edges are not smooth (quadrature is split there). Throws std::invalid_argument naming the
  /// fault (zero span, crossed edges, zero area, a gap without a chord between root and tip).
  Planform(std::function<double(double)> leading, std::function<double(double)> trailing,
           double y_root, double y_tip, std::vector<double> breaks = {});

  // These throw std::invalid_argument for lengths that are not > 0, stations that do not increase,
  // are too few or unequally many, and for whatever the constructor refuses.
  /// Rectangle of chord c, span b, hinge at `hinge` chords behind the leading edge, root edge at y
  /// = y_root.
  static Planform rectangle(double chord, double span, double hinge, double y_root = 0.0);
  /// Ellipse with full axes `chord` (x) and `span` (y), its root end at y = y_root, hinge as above.
  static Planform ellipse(double chord, double span, double hinge, double y_root = 0.0);
  /// Piecewise linear edges through stations; `y` strictly increasing.
  static Planform table(const std::vector<double>& y, const std::vector<double>& leading,
                        const std::vector<double>& trailing);
  /// Least-squares polynomials (default 6th order) through the stations, clamped so that chord >=
  /// 0. Refused, too: an order above 2 sqrt(stations), edges that cross by more than 0.05 mean
  /// chords, or anywhere but towards root and tip, or miss the stations by more than 0.1 (rms).
  static Planform polynomial(const std::vector<double>& y, const std::vector<double>& leading,
                             const std::vector<double>& trailing, int order = 6);

  /// Scaled so that span (y_tip - y_root) and area take these values: y by one factor, x by
  /// another.
  Planform scaledTo(double span, double area) const;

  /// Swept back by `sweep` [rad], within +-pi/3: every chord is moved back by y tan(sweep), so
  /// span, area and chords stay.
  Planform sweptBack(double sweep) const;

  /// Without its tip: cut off along x so far from the root that `share` of the area is lost, in
  /// [0, 0.9].
  Planform withoutTip(double share) const;

  double yRoot() const { return y_root_; }
  double yTip() const { return y_tip_; }
  double span() const { return y_tip_ - y_root_; }
  double leading(double y) const { return leading_(y); }
  double trailing(double y) const { return trailing_(y); }
  double chord(double y) const;
  const std::vector<double>& breaks() const { return breaks_; }

  double xMin() const { return x_min_; }  ///< bounding box in x
  double xMax() const { return x_max_; }

  double area() const { return area_; }
  double meanChord() const { return area_ / span(); }
  /// Integral of x^px y^py over the outline [m^(2+px+py)], to quadrature precision (rel. 1e-10).
  double moment(int px, int py) const;
  /// Integral of f(y, leading(y), trailing(y)) dy over the span, Gauss-Legendre split at the
  /// breaks.
  double integrateSpan(const std::function<double(double, double, double)>& f) const;

 private:
  std::function<double(double)> leading_, trailing_;
  double y_root_, y_tip_;
  std::vector<double> breaks_;
  double area_ = 0.0, x_min_ = 0.0, x_max_ = 0.0;
};

}  // namespace monarch_flight
