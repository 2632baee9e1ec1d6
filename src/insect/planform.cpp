#include "monarch_flight/insect/planform.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "insect/quadrature.h"

namespace monarch_flight {
namespace {

[[noreturn]] void reject(const std::string& fault) { throw std::invalid_argument(fault); }

double integerPower(double base, int exponent) {
  double result = 1.0;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

/// Largest value of `edge` (sign = +1) or of its negative (sign = -1) on [a, b]: dense samples,
/// then a golden-section search around the best one.
double extreme(const std::function<double(double)>& edge, double a, double b, double sign) {
  constexpr int kSamples = 64;
  const double h = (b - a) / kSamples;
  int best = 0;
  for (int i = 1; i <= kSamples; ++i) {
    if (sign * edge(a + i * h) > sign * edge(a + best * h)) best = i;
  }
  double lo = a + std::max(best - 1, 0) * h;
  double hi = a + std::min(best + 1, kSamples) * h;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 60; ++i) {
    const double left = hi - golden * (hi - lo);
    const double right = lo + golden * (hi - lo);
    if (sign * edge(left) > sign * edge(right)) {
      hi = right;
    } else {
      lo = left;
    }
  }
  return sign * std::max(sign * edge(0.5 * (lo + hi)), sign * edge(a + best * h));
}

/// Interval ends: root, interior breaks in order, tip.
std::vector<double> panelEnds(double y_root, double y_tip, const std::vector<double>& breaks) {
  std::vector<double> ends{y_root};
  ends.insert(ends.end(), breaks.begin(), breaks.end());
  ends.push_back(y_tip);
  return ends;
}

/// The trailing edge must not lie ahead of the leading one on [a, b], rounding relative to `scale`
/// apart.
void requireOrderedEdges(const std::function<double(double)>& leading,
                         const std::function<double(double)>& trailing, double a, double b,
                         double scale) {
  constexpr int kSamples = 64;
  for (int k = 0; k <= kSamples; ++k) {
    const double y = a + (b - a) * k / kSamples;
    const double chord = leading(y) - trailing(y);
    if (chord >= -1e-12 * scale) continue;
    std::ostringstream text;
    text << "chord at y = " << y << " m is " << chord
         << " m: must be >= 0; the trailing edge must not lie ahead of the leading edge";
    reject(text.str());
  }
}

/// A wing is one piece: no stretch without a chord between stretches that have one. Ends at the
/// first and the last panel may have none.
void requireOnePiece(const std::function<double(double)>& leading,
                     const std::function<double(double)>& trailing, const std::vector<double>& ends,
                     double scale) {
  constexpr int kSamples = 64;
  double last = ends.front(), gap_from = ends.front();
  bool begun = false, gap = false;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    for (int k = 0; k <= kSamples; ++k) {
      const double y = ends[i] + (ends[i + 1] - ends[i]) * k / kSamples;
      const bool wing = leading(y) - trailing(y) > 1e-12 * scale;
      if (wing && begun && gap && last - gap_from > 1e-9 * (ends.back() - ends.front())) {
        std::ostringstream text;
        text << "no chord from y = " << gap_from << " m to y = " << last
             << " m: the wing must be one piece from root to tip; give these stations a chord "
                "(edges that are polynomials: change the order, or take type csv)";
        reject(text.str());
      }
      if (!wing && !gap) gap_from = y;
      last = y;
      gap = !wing;
      begun = begun || wing;
    }
  }
}

}  // namespace

Planform::Planform(std::function<double(double)> leading, std::function<double(double)> trailing,
                   double y_root, double y_tip, std::vector<double> breaks)
    : leading_(std::move(leading)),
      trailing_(std::move(trailing)),
      y_root_(y_root),
      y_tip_(y_tip),
      breaks_(std::move(breaks)) {
  if (!std::isfinite(y_root_) || !std::isfinite(y_tip_) || !(y_tip_ > y_root_)) {
    std::ostringstream text;
    text << "span = " << y_tip_ - y_root_ << " m: must be > 0; let the tip lie beyond the root";
    reject(text.str());
  }
  const double outside = 1e-12 * span();
  breaks_.erase(
      std::remove_if(breaks_.begin(), breaks_.end(),
                     [&](double y) { return !(y > y_root_ + outside && y < y_tip_ - outside); }),
      breaks_.end());
  std::sort(breaks_.begin(), breaks_.end());
  const std::vector<double> ends = panelEnds(y_root_, y_tip_, breaks_);
  x_min_ = trailing_(y_root_);
  x_max_ = leading_(y_root_);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    x_max_ = std::max(x_max_, extreme(leading_, ends[i], ends[i + 1], 1.0));
    x_min_ = std::min(x_min_, extreme(trailing_, ends[i], ends[i + 1], -1.0));
    requireOrderedEdges(leading_, trailing_, ends[i], ends[i + 1], x_max_ - x_min_);
  }
  requireOnePiece(leading_, trailing_, ends, x_max_ - x_min_);
  area_ = moment(0, 0);
  if (!std::isfinite(area_) || !(area_ > 0.0)) reject("area must be > 0; give the outline a chord");
}

Planform Planform::scaledTo(double span_wanted, double area_wanted) const {
  if (!(span_wanted > 0.0) || !std::isfinite(span_wanted)) reject("scaled span must be > 0");
  if (!(area_wanted > 0.0) || !std::isfinite(area_wanted)) reject("scaled area must be > 0");
  const double fy = span_wanted / span();
  const double fx = area_wanted / (area_ * fy);
  const auto scaled = [fx, fy](const std::function<double(double)>& edge) {
    return [edge, fx, fy](double y) { return fx * edge(y / fy); };
  };
  std::vector<double> breaks = breaks_;
  for (double& y : breaks) y *= fy;
  const double y_root = y_root_ * fy;
  return Planform(scaled(leading_), scaled(trailing_), y_root, y_root + span_wanted, breaks);
}

Planform Planform::sweptBack(double sweep) const {
  if (!(std::abs(sweep) <= M_PI / 3.0)) {
    std::ostringstream text;
    text << "sweep = " << sweep << " rad: must be within +-pi/3; 0 leaves the outline as it is";
    reject(text.str());
  }
  if (sweep == 0.0) return *this;
  const double slope = std::tan(sweep);
  const auto swept = [slope](const std::function<double(double)>& edge) {
    return [edge, slope](double y) { return edge(y) - slope * y; };
  };
  return Planform(swept(leading_), swept(trailing_), y_root_, y_tip_, breaks_);
}

Planform Planform::withoutTip(double share) const {
  if (!(share >= 0.0 && share <= 0.9))
    reject("share of the area that is cut off: must be in [0, 0.9]");
  if (share == 0.0) return *this;
  const auto cutAt = [this](double y) {
    return Planform(leading_, trailing_, y_root_, y, breaks_);
  };
  double inner = y_root_ + 1e-3 * span(), outer = y_tip_;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inner + outer);
    (cutAt(middle).area() < (1.0 - share) * area_ ? inner : outer) = middle;
  }
  return cutAt(outer);
}

double Planform::chord(double y) const {
  if (y < y_root_ || y > y_tip_) return 0.0;
  return std::max(0.0, leading_(y) - trailing_(y));
}

double Planform::integrateSpan(const std::function<double(double, double, double)>& f) const {
  // On each panel y = middle - half cos(t), t in [0, pi]: edges that end like a square root
  // (ellipse) become smooth in t, and polynomials stay smooth.
  const auto& rule = spanRule();
  double sum = 0.0;
  double from = y_root_;
  for (std::size_t i = 0; i <= breaks_.size(); ++i) {
    const double to = i < breaks_.size() ? breaks_[i] : y_tip_;
    const double half = 0.5 * (to - from);
    for (int k = 0; k < kSpanNodes; ++k) {
      const double t = 0.5 * M_PI * (1.0 + rule.node[k]);
      const double y = from + half * (1.0 - std::cos(t));
      sum += rule.weight[k] * 0.5 * M_PI * half * std::sin(t) * f(y, leading_(y), trailing_(y));
    }
    from = to;
  }
  return sum;
}

double Planform::moment(int px, int py) const {
  return integrateSpan([px, py](double y, double leading, double trailing) {
    const double x_part =
        (integerPower(leading, px + 1) - integerPower(trailing, px + 1)) / (px + 1);
    return x_part * integerPower(y, py);
  });
}

}  // namespace monarch_flight
