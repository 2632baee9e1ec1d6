// The flow solver against Taylor-Green vortices, Stokes' first problem and the momentum balance.
// The full studies: monarch verify.
#include <gtest/gtest.h>

#include <cmath>

#include "verify/momentum_box.h"
#include "verify/setup.h"

namespace monarch_flight::verify {
namespace {

constexpr double kViscosity = 0.02;

Vector3d vortices(const Vector3d& r, double t) {
  const double decay = std::exp(-2 * kViscosity * M_PI * M_PI * t);
  return decay * Vector3d(std::sin(M_PI * r.x()) * std::cos(M_PI * r.y()),
                          -std::cos(M_PI * r.x()) * std::sin(M_PI * r.y()), 0);
}

/// Root of the mean square error of u in the inner half of a grid that translates and turns.
double vortexError(int n) {
  const Axis axis = uniformAxis(-1, 1, n);
  NavierStokes flow(makeGrid(axis, axis, axis, n / 2, false,
                             std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n, 0)),
                    airOf(1, kViscosity), 1, kNoCourantLimit);
  auto motion = [](double t) {
    const Vector3d omega(0.6, -0.4, 0.9), V(0.3, 0.2, -0.25);
    WingMotion m;
    m.R_IW = expSO3(omega * t);
    m.omega_W = omega;
    m.r_I = V * t;
    m.v_W = m.R_IW.transpose() * V;
    return m;
  };
  const int steps = 2 * n;
  const double T = 0.5, dt = T / steps;
  flow.start(motion(0), dt);
  flow.setKnownFlow(vortices);
  for (int s = 1; s <= steps; ++s) {
    flow.evaluate(motion(s * dt));
    flow.commit();
  }
  const WingMotion m = motion(T);
  double sum = 0;
  for (int k = n / 4; k < n - n / 4; ++k)
    for (int j = n / 4; j < n - n / 4; ++j)
      for (int i = n / 4; i < n - n / 4; ++i) {
        const Vector3d r(axis.face[i], axis.centre[j], axis.centre[k]);
        const double exact = m.R_IW.col(0).dot(vortices(m.r_I + m.R_IW * r, T));
        const double e = flow.velocity().c[0][flow.layout().at(i, j, k)] - exact;
        sum += e * e;
      }
  return std::sqrt(8 * sum / (static_cast<double>(n) * n * n));
}

TEST(ExactFlows, TaylorGreenOnAMovingGridIsOfSecondOrder) {
  const double coarse = vortexError(12), fine = vortexError(24);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
  EXPECT_LT(fine, 0.01);
}

TEST(ExactFlows, WallShearOfStokesFirstProblem) {
  const double nu = 0.01, size = 400;
  const int n = 12, steps = 64;
  std::vector<std::uint8_t> wing(n * n, 0);
  for (int j = 2; j < n - 2; ++j)
    for (int i = 2; i < n - 2; ++i) wing[j * n + i] = 1;
  const Axis plane = uniformAxis(-size, size, n), z = coreAxis(0.9, 32, 1.5, size);
  NavierStokes flow(makeGrid(plane, plane, z, z.n() / 2, false, wing), airOf(1, nu), 1,
                    kNoCourantLimit);
  WingMotion m;
  m.v_W = Vector3d(1, 0, 0);
  flow.start(m, 1.0 / steps);
  for (int s = 1; s <= steps; ++s) {
    flow.evaluate(m);
    flow.commit();
  }
  for (int k : {flow.grid().k_wing - 1, flow.grid().k_wing}) {
    const double u = flow.velocity().c[0][flow.layout().at(n / 2, n / 2, k)];
    const double shear = nu * (1 - u) / (0.5 * z.width[k]);
    EXPECT_NEAR(shear / std::sqrt(nu / M_PI), 1.0, 0.01);
  }
}

// What the wing feels is what the air around it loses. Coarse here: an error of a few percent.
TEST(ExactFlows, LoadsOfAHeavingPlateAreTheMomentumOfTheAir) {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = 10;
  s.first_cell = 0.05;
  s.margin = 0.6;
  s.far_field = 4;
  s.courant_limit = kNoCourantLimit;
  const double rho = 1.2, mu = 0.06, dt = 0.005;
  NavierStokes flow(makeGrid(Planform::rectangle(1, 1, 0.5, -0.5), s), airOf(rho, mu), 1,
                    kNoCourantLimit);
  const Grid& g = flow.grid();
  auto at = [](const Axis& a, double x) {
    int i = 0;
    while (a.face[i] < x) ++i;
    return i;
  };
  const int low[3] = {at(g.x, -0.9), at(g.y, -0.9), at(g.z, -0.6)};
  const int high[3] = {at(g.x, 0.9), at(g.y, 0.9), at(g.z, 0.6)};
  const Box box(flow, low, high, rho, mu);
  auto motion = [](double t) {
    const Vector3d z = oscillation(0.15, 2 * M_PI, t, -M_PI / 2);
    return flapAndPitch(Vector3d::Zero(), Vector3d::Zero(), Vector3d(0.3, 0, z[1]),
                        Vector3d(0, 0, z[2]));
  };
  flow.start(motion(0), dt);
  double P[2] = {0, 0}, flux = 0, force = 0, peak = 0, worst = 0;
  for (int n = 1; n <= 60; ++n) {
    const WingMotion m = motion(n * dt);
    const double now = flow.evaluate(m).force().z();
    flow.commit();
    const double momentum = box.momentum().z();
    if (n > 20) {
      worst = std::max(worst, std::abs(flux - (momentum - P[0]) / (2 * dt) - force));
      peak = std::max(peak, std::abs(force));
    }
    P[0] = P[1];
    P[1] = momentum;
    flux = box.inflow({m.v_W, m.omega_W}).z();
    force = now;
  }
  EXPECT_GT(peak, 0.5);
  EXPECT_LT(worst, 0.03 * peak);
}

}  // namespace
}  // namespace monarch_flight::verify
