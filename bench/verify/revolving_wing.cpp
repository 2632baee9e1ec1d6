// Wing that revolves about its root at a constant angle of attack, Re 136, against fits to the
// forces of a robot's wing. Bounds: docs/verification.md, "References from outside".
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr double kRamp = 2;  // time until the rate is constant
constexpr double kCells[3] = {10, 14, 20}, kSpacing[3] = {1 / 10.0, 1 / 14.0, 1 / 20.0};

/// Speed of the tip and area / length, with the length from the axis, are 1: the mean chord of the
/// Reynolds number and of `length`. The grid counts cells and the box in area / span, the chord of
/// the wing alone: 1.25 for a root at 0.2, so 10 cells a chord are 8 for each unit of length, and
/// the Reynolds number is 170 by that chord. Which one the source means is not known.
struct Wing {
  double reynolds = 136;  ///< by area / length
  double length = 3.54;   ///< axis to tip
  double root = 0.2;      ///< where the wing begins, in lengths
  double far_field = 10;  ///< area / span
  double span() const { return (1 - root) * length; }
  double rate() const { return 1 / length; }
  /// Of the ellipse's area about the axis.
  double secondMoment() const {
    const double middle = root * length + 0.5 * span();
    return length * (middle * middle + span() * span() / 16);
  }
};

/// Angle travelled, its rate and acceleration.
Vector3d travelled(double t, double rate) {
  if (t >= kRamp) return {rate * (t - 0.5 * kRamp), rate, 0};
  const double w = M_PI / kRamp;
  return {0.5 * rate * (t - std::sin(w * t) / w), 0.5 * rate * (1 - std::cos(w * t)),
          0.5 * rate * w * std::sin(w * t)};
}

/// Leading edge forward and up.
WingMotion motionAt(double t, double alpha, double rate) {
  const Vector3d a = travelled(t, rate), down(-std::sin(alpha), 0, std::cos(alpha));
  WingMotion m;
  m.R_IW = rotationZ(-a[0]) * rotationY(alpha);
  m.omega_W = -a[1] * down;
  m.alpha_W = -a[2] * down;
  return m;
}

struct Coefficients {
  double lift, drag, late_lift, late_drag;  ///< means over 60 to 120 and 120 to 170 deg
};

Coefficients fly(double degrees, double cells_per_chord, const Wing& wing) {
  const double alpha = degrees * M_PI / 180, rate = wing.rate();
  const double chord = 4 * wing.length / (M_PI * wing.span());
  const auto flow = makeNavierStokes(
      Planform::ellipse(chord, wing.span(), 0.25, wing.root * wing.length),
      airOf(1, 1 / wing.reynolds), scaled("preview", cells_per_chord, wing.far_field));
  const double dt = 0.4 / cells_per_chord;
  const int steps = static_cast<int>(std::ceil((M_PI / rate + 0.5 * kRamp) / dt));
  const auto loads = verify::fly(
      *flow, [&](double t) { return motionAt(t, alpha, rate); }, dt, steps);
  auto mean = [&](double from, double to) {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (int n = 0; n < steps; ++n) {
      const double angle = travelled((n + 1) * dt, rate)[0] * 180 / M_PI;
      if (angle < from || angle > to) continue;
      sum += rotationY(alpha) * loads[n].force();
      ++count;
    }
    return Vector3d(-sum / count / (0.5 * rate * rate * wing.secondMoment()));
  };
  const Vector3d middle = mean(60, 120), late = mean(120, 170);
  return {middle.z(), middle.x(), late.z(), late.x()};
}

/// What is not known of the robot's wing, at 45 deg on the middle grid.
void setUp(Report& report, const Coefficients& as_assumed) {
  const struct {
    const char* name;
    Wing wing;
  } cases[] = {{"Re 272", {272, 3.54, 0.2, 10}},  {"Re 1000", {1000, 3.54, 0.2, 10}},
               {"length 3", {136, 3, 0.2, 10}},   {"length 4", {136, 4, 0.2, 10}},
               {"root at 0", {136, 3.54, 0, 10}}, {"root at 0.3", {136, 3.54, 0.3, 10}},
               {"box 20", {136, 3.54, 0.2, 20}}};
  for (const auto& c : cases) {
    const Coefficients other = fly(45, kCells[1], c.wing);
    const std::string name = c.name;
    report.state("45 deg: CL, " + name, "14 cells a chord", other.lift, as_assumed.lift);
    report.state("45 deg: CD, " + name, "14 cells a chord", other.drag, as_assumed.drag);
  }
}

double radians(double degrees) { return degrees * M_PI / 180; }

}  // namespace

void revolvingWing(Report& report) {
  for (double degrees : {45.0, 22.5, 67.5}) {
    const double cl = 0.225 + 1.58 * std::sin(radians(2.13 * degrees - 7.20));
    const double cd = 1.92 - 1.55 * std::cos(radians(2.04 * degrees - 9.82));
    const std::string at = text("%g deg: ", degrees);
    double lift[3], drag[3];
    Coefficients c, middle;
    for (int i = degrees == 45 ? 0 : 2; i < 3; ++i) {
      c = fly(degrees, kCells[i], Wing());
      lift[i] = c.lift, drag[i] = c.drag;
      if (i == 2) continue;
      middle = c;
      report.state(at + "CL, robot", text("%g cells a chord", kCells[i]), c.lift, cl);
      report.state(at + "CD, robot", text("%g cells a chord", kCells[i]), c.drag, cd);
    }
    report.near(at + "CL, robot", "20 cells a chord", c.lift, cl, 0.14);
    report.near(at + "CD, robot", "20 cells a chord", c.drag, cd, 0.14);
    report.state(at + "CL, 120 to 170 deg of travel", "20 cells a chord", c.late_lift, c.lift);
    report.state(at + "CD, 120 to 170 deg of travel", "20 cells a chord", c.late_drag, c.drag);
    if (degrees != 45) continue;
    const Extrapolated l = extrapolate(kSpacing, lift), d = extrapolate(kSpacing, drag);
    report.state(at + "CL against extrapolated", "20 cells a chord", lift[2], l.value);
    report.state(at + "CD against extrapolated", "20 cells a chord", drag[2], d.value);
    setUp(report, middle);
  }
}

}  // namespace monarch_flight::verify
