// Wing that revolves about its root at a constant angle of attack, Re 136, against fits to the
// forces of a robot's wing. Bounds: docs/verification.md, "Other wings".
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr double kReynolds = 136;        // tip speed * area / length; both are 1
constexpr double kLength = 3.54;         // axis to tip
constexpr double kRoot = 0.2 * kLength;  // where the wing begins
constexpr double kSpan = kLength - kRoot, kArea = kLength;
constexpr double kRate = 1 / kLength;  // the tip moves at 1
constexpr double kRamp = 2;            // time until the rate is constant
constexpr double kCells[3] = {10, 14, 20}, kSpacing[3] = {1 / 10.0, 1 / 14.0, 1 / 20.0};

/// Second moment of the ellipse's area about the axis.
double secondMoment() {
  const double middle = kRoot + 0.5 * kSpan;
  return kArea * (middle * middle + kSpan * kSpan / 16);
}

/// Angle travelled, its rate and acceleration.
Vector3d travelled(double t) {
  if (t >= kRamp) return {kRate * (t - 0.5 * kRamp), kRate, 0};
  const double w = M_PI / kRamp;
  return {0.5 * kRate * (t - std::sin(w * t) / w), 0.5 * kRate * (1 - std::cos(w * t)),
          0.5 * kRate * w * std::sin(w * t)};
}

/// Leading edge forward and up.
WingMotion motionAt(double t, double alpha) {
  const Vector3d a = travelled(t), down(-std::sin(alpha), 0, std::cos(alpha));
  WingMotion m;
  m.R_IW = rotationZ(-a[0]) * rotationY(alpha);
  m.omega_W = -a[1] * down;
  m.alpha_W = -a[2] * down;
  return m;
}

struct Coefficients {
  double lift, drag, late_lift, late_drag;  ///< means over 60 to 120 and 120 to 170 deg
};

Coefficients fly(double degrees, double cells_per_chord) {
  const double alpha = degrees * M_PI / 180, chord = 4 * kArea / (M_PI * kSpan);
  const auto flow = makeNavierStokes(Planform::ellipse(chord, kSpan, 0.25, kRoot),
                                     airOf(1, 1 / kReynolds), likePreview(cells_per_chord, 10));
  const double dt = 0.4 / cells_per_chord;
  const int steps = static_cast<int>(std::ceil((M_PI / kRate + 0.5 * kRamp) / dt));
  const auto loads = verify::fly(
      *flow, [&](double t) { return motionAt(t, alpha); }, dt, steps);
  auto mean = [&](double from, double to) {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (int n = 0; n < steps; ++n) {
      const double angle = travelled((n + 1) * dt)[0] * 180 / M_PI;
      if (angle < from || angle > to) continue;
      sum += rotationY(alpha) * loads[n].force();
      ++count;
    }
    return Vector3d(-sum / count / (0.5 * kRate * kRate * secondMoment()));
  };
  const Vector3d middle = mean(60, 120), late = mean(120, 170);
  return {middle.z(), middle.x(), late.z(), late.x()};
}

double radians(double degrees) { return degrees * M_PI / 180; }

}  // namespace

void revolvingWing(Report& report) {
  for (double degrees : {45.0, 22.5, 67.5}) {
    const double cl = 0.225 + 1.58 * std::sin(radians(2.13 * degrees - 7.20));
    const double cd = 1.92 - 1.55 * std::cos(radians(2.04 * degrees - 9.82));
    const std::string at = text("%g deg: ", degrees);
    double lift[3], drag[3];
    Coefficients c;
    for (int i = degrees == 45 ? 0 : 2; i < 3; ++i) {
      c = fly(degrees, kCells[i]);
      lift[i] = c.lift, drag[i] = c.drag;
      if (i == 2) continue;
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
  }
}

}  // namespace monarch_flight::verify
