#include "fluid/quasi_steady/coefficients.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/math/angle.h"

namespace monarch_flight::fluid::quasi_steady {
namespace {

// The fitted lift is 0.027 at 0 and 0.101 at 90 degrees, where symmetry demands 0 and where its
// side changes: it is led to 0 linearly over this angle, for a step in the loads would have no
// fixed point.
constexpr double kTaper = 5.0 * kDegree;

SectionCoefficients saneDickinson(double alpha) {
  const double acute = std::min(alpha, kPi - alpha);
  const double taper = std::min({1.0, acute / kTaper, (0.5 * kPi - acute) / kTaper});
  SectionCoefficients c;
  c.lift = std::max(taper, 0.0) * (0.225 + 1.58 * std::sin(2.13 * acute - 7.2 * kDegree));
  c.drag = 1.92 - 1.55 * std::cos(2.04 * acute - 9.82 * kDegree);
  c.centre_of_pressure = 0.90 * alpha / kPi + 0.05;
  return c;
}

SectionCoefficients whitneyWood(double alpha) {
  const double acute = std::min(alpha, kPi - alpha);
  SectionCoefficients c;
  c.lift = 1.8 * std::sin(2.0 * acute);
  c.drag = 1.9 - 1.5 * std::cos(2.0 * acute);
  c.centre_of_pressure = 0.82 * alpha / kPi + 0.05;
  return c;
}

}  // namespace

SectionCoefficients sectionCoefficients(BladeElementVariant variant, double alpha) {
  return variant == BladeElementVariant::kWhitneyWood ? whitneyWood(alpha) : saneDickinson(alpha);
}

double rotationalDampingCoefficient(BladeElementVariant variant) {
  if (variant == BladeElementVariant::kWhitneyWood) return 5.0;
  return saneDickinson(0.5 * kPi).drag;
}

}  // namespace monarch_flight::fluid::quasi_steady
