#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "monarch_flight/insect/planform.h"

namespace monarch_flight {
namespace {

void requirePositive(double value, const char* what) {
  if (std::isfinite(value) && value > 0.0) return;
  std::ostringstream text;
  text << what << " = " << value << " m: must be > 0";
  throw std::invalid_argument(text.str());
}

void requireStations(const std::vector<double>& y, const std::vector<double>& leading,
                     const std::vector<double>& trailing, std::size_t least) {
  std::ostringstream text;
  if (y.size() != leading.size() || y.size() != trailing.size()) {
    text << "stations y, leading, trailing have " << y.size() << ", " << leading.size() << ", "
         << trailing.size() << " values: must be equally many";
    throw std::invalid_argument(text.str());
  }
  if (y.size() < least) {
    text << y.size() << " stations: must be >= " << least << "; give more stations";
    throw std::invalid_argument(text.str());
  }
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(y[i]) || !std::isfinite(leading[i]) || !std::isfinite(trailing[i])) {
      text << "station " << i + 1 << " holds a value that is not a finite number; correct it";
      throw std::invalid_argument(text.str());
    }
    if (i > 0 && !(y[i] > y[i - 1])) {
      text << "y of station " << i + 1 << " = " << y[i] << ": must be > " << y[i - 1]
           << " of the station before; sort the stations from root to tip";
      throw std::invalid_argument(text.str());
    }
  }
}

/// Piecewise linear interpolation, constant outside.
double interpolate(const std::vector<double>& x, const std::vector<double>& f, double at) {
  if (at <= x.front()) return f.front();
  if (at >= x.back()) return f.back();
  const std::size_t i = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  const double s = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return f[i - 1] + s * (f[i] - f[i - 1]);
}

/// Least-squares polynomial in the station coordinate mapped to [-1, 1] (well conditioned).
struct Polynomial {
  double middle, half;
  Eigen::VectorXd coefficient;

  Polynomial(const std::vector<double>& y, const std::vector<double>& f, int order)
      : middle(0.5 * (y.front() + y.back())), half(0.5 * (y.back() - y.front())) {
    Eigen::MatrixXd powers(y.size(), order + 1);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double s = (y[i] - middle) / half;
      powers(i, 0) = 1.0;
      for (int k = 1; k <= order; ++k) powers(i, k) = powers(i, k - 1) * s;
    }
    const Eigen::Map<const Eigen::VectorXd> values(f.data(), f.size());
    coefficient = powers.colPivHouseholderQr().solve(values);
  }

  double operator()(double y) const {
    const double s = (y - middle) / half;
    double value = 0.0;
    for (Eigen::Index k = coefficient.size() - 1; k >= 0; --k) value = value * s + coefficient[k];
    return value;
  }
};

/// The polynomials must be what the stations are: of an order that so many of them carry without
/// swinging between them, near them, and crossed by rounding at root and tip at most.
void requireFaithful(const std::vector<double>& y, const std::vector<double>& leading,
                     const std::vector<double>& trailing, const Polynomial& le,
                     const Polynomial& te) {
  constexpr double kMostResidual = 0.1, kMostCrossing = 0.05;  // of the mean chord
  constexpr int kSamples = 512;
  double squares = 0.0, sum = 0.0, deepest = 0.0, at = y.front();
  for (std::size_t i = 0; i < y.size(); ++i) {
    squares += std::pow(le(y[i]) - leading[i], 2) + std::pow(te(y[i]) - trailing[i], 2);
  }
  for (int i = 0; i <= kSamples; ++i) {
    const double here = y.front() + (y.back() - y.front()) * i / kSamples;
    const double chord = le(here) - te(here);
    sum += std::max(0.0, chord);
    if (chord >= deepest) continue;
    deepest = chord;
    at = here;
  }
  const double mean = sum / (kSamples + 1), rms = std::sqrt(0.5 * squares / y.size());
  std::ostringstream text;
  if (deepest < -kMostCrossing * mean) {
    text << "the polynomials of the edges cross, by " << -deepest << " m at y = " << at
         << " m: must be <= " << kMostCrossing << " mean chords; change the order or take type csv";
  } else if (rms > kMostResidual * mean) {
    text << "the polynomials miss the stations by " << rms
         << " m (rms): must be <= " << kMostResidual << " mean chords, " << kMostResidual * mean
         << " m; raise the order or take type csv";
  }
  if (!text.str().empty()) throw std::invalid_argument(text.str());
}

/// Stations in (a, b) where `chord` changes sign: there the clamp makes the edges non-smooth.
std::vector<double> signChanges(const std::function<double(double)>& chord, double a, double b) {
  constexpr int kSamples = 512;
  std::vector<double> zeros;
  for (int i = 0; i < kSamples; ++i) {
    double lo = a + (b - a) * i / kSamples;
    double hi = a + (b - a) * (i + 1) / kSamples;
    if (chord(lo) * chord(hi) >= 0.0) continue;
    for (int k = 0; k < 60; ++k) {
      const double mid = 0.5 * (lo + hi);
      (chord(lo) * chord(mid) <= 0.0 ? hi : lo) = mid;
    }
    zeros.push_back(0.5 * (lo + hi));
  }
  return zeros;
}

}  // namespace

Planform Planform::rectangle(double chord, double span, double hinge, double y_root) {
  requirePositive(chord, "chord");
  requirePositive(span, "span");
  const double leading = hinge * chord;
  const double trailing = leading - chord;
  return Planform([leading](double) { return leading; }, [trailing](double) { return trailing; },
                  y_root, y_root + span);
}

Planform Planform::ellipse(double chord, double span, double hinge, double y_root) {
  requirePositive(chord, "chord");
  requirePositive(span, "span");
  const double centre = (hinge - 0.5) * chord;
  const double y_centre = y_root + 0.5 * span;
  const auto half_chord = [chord, span, y_centre](double y) {
    const double s = (y - y_centre) / (0.5 * span);
    return 0.5 * chord * std::sqrt(std::max(0.0, (1.0 - s) * (1.0 + s)));
  };
  // The break at mid-span lets the bounding box see the largest half chord exactly.
  return Planform([=](double y) { return centre + half_chord(y); },
                  [=](double y) { return centre - half_chord(y); }, y_root, y_root + span,
                  {y_centre});
}

Planform Planform::table(const std::vector<double>& y, const std::vector<double>& leading,
                         const std::vector<double>& trailing) {
  requireStations(y, leading, trailing, 2);
  return Planform([y, leading](double at) { return interpolate(y, leading, at); },
                  [y, trailing](double at) { return interpolate(y, trailing, at); }, y.front(),
                  y.back(), y);
}

Planform Planform::polynomial(const std::vector<double>& y, const std::vector<double>& leading,
                              const std::vector<double>& trailing, int order) {
  requireStations(y, leading, trailing, 2);
  const int most =
      std::min(static_cast<int>(2.0 * std::sqrt(y.size())), static_cast<int>(y.size()) - 1);
  if (order < 1 || order > most) {
    throw std::invalid_argument("order of the planform's polynomials = " + std::to_string(order) +
                                ": must be from 1 to " + std::to_string(most) + " with " +
                                std::to_string(y.size()) +
                                " stations, or they swing between them; change the order");
  }
  const Polynomial le(y, leading, order);
  const Polynomial te(y, trailing, order);
  requireFaithful(y, leading, trailing, le, te);
  // Where the polynomials cross, both edges take their mean: chord 0.
  const auto clamped = [le, te](double at, bool front) {
    const double a = le(at);
    const double b = te(at);
    if (a < b) return 0.5 * (a + b);
    return front ? a : b;
  };
  const auto chord = [le, te](double at) { return le(at) - te(at); };
  return Planform([clamped](double at) { return clamped(at, true); },
                  [clamped](double at) { return clamped(at, false); }, y.front(), y.back(),
                  signChanges(chord, y.front(), y.back()));
}

}  // namespace monarch_flight
