// Friction beside the wing's rim: its factors against the singular solutions, and what they bring.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/fluid_flapping.h"
#include "fluid/momentum/rim_friction.h"

namespace monarch_flight::fluid::momentum {
namespace {

using Function = std::function<double(double x, double z)>;

double angle(double x, double z) { return std::atan2(z, x); }
double radius(double x, double z) { return std::hypot(x, z); }

/// Stream function of Stokes flow along a half-plane (x < 0), over its edge.
double psiOver(double x, double z) {
  const double t = angle(x, z);
  return std::pow(radius(x, z), 1.5) * (std::sin(1.5 * t) + std::sin(0.5 * t));
}
/// Velocity along the edge: harmonic.
double along(double x, double z) { return std::sqrt(radius(x, z)) * std::cos(0.5 * angle(x, z)); }

/// Derivative by central differences, small beside the distance to the edge.
double derivative(const Function& f, int direction, double x, double z, double h) {
  return direction == 0 ? (f(x + h, z) - f(x - h, z)) / (2 * h)
                        : (f(x, z + h) - f(x, z - h)) / (2 * h);
}

/// Integral over (0, end) of what grows as 1 / sqrt(s) towards 0.
double integral(double end, const std::function<double(double s)>& f) {
  constexpr int n = 200;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double root = std::sqrt(end) * (i + 0.5) / n;
    sum += f(root * root) * 2 * root * std::sqrt(end) / n;
  }
  return sum;
}

TEST(RimFriction, FactorsAreThoseOfTheSingularSolutions) {
  const Function u = [](double x, double z) {
    return derivative(psiOver, 1, x, z, 1e-4 * radius(x, z));
  };
  for (double a : {0.25, 0.56, 1.0, 1.5}) {
    // On the wing by differences from the wall, where u and v are 0: of second order.
    auto shear = [](const Function& f) {
      return [&f](double s) {
        const double h = 1e-3 * s;
        return (4 * f(-s, h) - f(-s, 2 * h)) / (2 * h);
      };
    };
    const double flux = integral(a, [&](double s) { return u(0, s); }) / a;
    EXPECT_NEAR(RimFriction::overEdge(a), integral(0.5, shear(u)) / (flux / (a / 2)), 1e-3) << a;
    EXPECT_NEAR(RimFriction::alongEdge(a),
                integral(1, shear(along)) / (along(-0.5, a / 2) / (a / 2)), 1e-3)
        << a;
    const double beside =
        integral(a, [&](double s) { return derivative(along, 0, 0, s, 1e-3 * s); }) / a;
    EXPECT_NEAR(RimFriction::besideEdge(a), beside / (along(0.5, a / 2) - along(-0.5, a / 2)), 1e-3)
        << a;
  }
}

/// Force of a square plate on slow air: moves to the north, leading edge up by `degrees`.
Eigen::Vector3d drag(double degrees, double cells_per_chord) {
  GridSettings s = smallGrid();
  s.cells_per_chord = cells_per_chord;
  s.first_cell = 0.5 / cells_per_chord;
  s.growth_plane = s.growth_normal = 1 + 2.4 / cells_per_chord;
  s.far_field = 3;
  const double angle = degrees * M_PI / 180, dt = 0.04;
  auto motion = [&](double t) {
    WingMotion m;
    m.R_IW = rotationY(angle);
    m.r_I = Eigen::Vector3d(t, 0, 0);
    m.v_W = m.R_IW.transpose() * Eigen::Vector3d(1, 0, 0);
    return m;
  };
  Air air;
  air.rho = 1;
  air.mu = 0.1;
  const auto flow = makeNavierStokes(Planform::rectangle(1, 1, 0.5, -0.5), air, s);
  flow->start(motion(0), dt);
  Loads loads;
  for (int n = 1; n <= 50; ++n) {
    loads = flow->evaluate(motion(n * dt));
    flow->commit();
  }
  return rotationY(angle) * loads.force();
}

TEST(RimFriction, CoarseCellsGiveTheForceOfFineOnes) {
  for (double degrees : {0.0, 45.0, 90.0}) {
    const Eigen::Vector3d coarse = drag(degrees, 8), fine = drag(degrees, 16);
    EXPECT_LT((coarse - fine).norm(), 0.02 * fine.norm())
        << degrees << ": " << coarse.transpose() << ", " << fine.transpose();
  }
}

}  // namespace
}  // namespace monarch_flight::fluid::momentum
