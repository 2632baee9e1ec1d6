// The flow solver against what is known exactly: a uniform stream seen from a turning wing, a wind,
// air at rest, Stokes' second problem.
#include <gtest/gtest.h>

#include "core/fluid_flapping.h"
#include "fluid/flow/flow.h"
#include "monarch_flight/insect/prescribed_motion.h"

namespace monarch_flight::fluid {
namespace {

using Eigen::Vector3d;

Axis uniformAxis(double low, double high, int n) {
  std::vector<double> f(n + 1);
  for (int i = 0; i <= n; ++i) f[i] = low + (high - low) * i / n;
  return Axis::fromFaces(f);
}

/// 2 n uniform cells over [-layer, layer], then doubling ones out to `far`: room for the return
/// flow.
Axis layerAxis(double layer, int n, double far) {
  std::vector<double> up{0.0};
  for (int i = 1; i <= n; ++i) up.push_back(layer * i / n);
  for (double w = layer / n; up.back() < far; w *= 1.5) up.push_back(up.back() + w);
  std::vector<double> f(up.rbegin(), up.rend() - 1);
  for (double& q : f) q = -q;
  f.insert(f.end(), up.begin(), up.end());
  return Axis::fromFaces(f);
}

Grid boxWithoutWing(int n) {
  return makeGrid(uniformAxis(-1, 1, n), uniformAxis(-0.5, 1.5, n), uniformAxis(-1, 1, n), n / 2,
                  false, std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n, 0));
}

double relative(const Loads& a, const Loads& b, double scale) {
  return ((a.force() - b.force()).norm() + (a.moment() - b.moment()).norm()) / scale;
}

/// Largest deviation of a component of the air from a uniform stream.
double strayedFrom(const NavierStokes& flow, const Vector3d& stream) {
  const Vector3d expected = flow.axes().transpose() * stream;
  double worst = 0;
  const Layout& l = flow.layout();
  for (int k = 0; k < l.nz; ++k)
    for (int j = 0; j < l.ny; ++j)
      for (int i = 0; i < l.nx; ++i)
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(flow.velocity().c[c][l.at(i, j, k)] - expected[c]));
  return worst;
}

TEST(NavierStokes, UniformStreamSurvivesAFullTurn) {
  NavierStokes flow(boxWithoutWing(12), thinAir(), 1.0, 100.0);
  const int steps = 150;
  const double dt = 0.01;
  const Vector3d omega = Vector3d(1, 2, -2).normalized() * (2 * M_PI / (steps * dt)),
                 V(1.0, -2.0, 0.5);
  auto motion = [&](int n) {
    WingMotion m;
    m.R_IW = expSO3(omega * (n * dt));  // omega is along a fixed axis: the same in both frames
    m.omega_W = omega;
    m.v_W = m.R_IW.transpose() * V;
    m.a_W.setZero();
    return m;
  };
  const Vector3d stream(0.3, -0.7, 1.1);
  flow.start(motion(0), dt);
  flow.setKnownFlow([&](const Vector3d&, double) { return stream; });
  for (int n = 1; n <= steps; ++n) {
    flow.evaluate(motion(n));
    flow.commit();
    if (n % 50 != 0) continue;
    EXPECT_LT(strayedFrom(flow, stream), 1e-10 * stream.norm()) << "step " << n;
  }
}

/// Largest deviation of the air from a uniform stream after `steps` steps of a wing's place that
/// flaps, pitches and moves on, in the axes of the components; `behind`: the largest angle between
/// these and the wing's [rad].
double strayed(int steps, double& behind) {
  NavierStokes flow(boxWithoutWing(8), thinAir(), 1.0, 100.0);
  const double dt = 1.0 / steps;
  const Vector3d stream(0.3, -0.7, 1.1);
  flow.start(flapping(0), dt);
  flow.setKnownFlow([&](const Vector3d&, double) { return stream; });
  double worst = behind = 0;
  for (int n = 1; n <= steps; ++n) {
    flow.evaluate(flapping(n * dt));
    flow.commit();
    behind = std::max(behind, logSO3(flow.axes().transpose() * flapping(n * dt).R_IW).norm());
    worst = std::max(worst, strayedFrom(flow, stream));
  }
  return worst / stream.norm();
}

TEST(NavierStokes, UniformStreamSurvivesAVaryingRateOfTurn) {
  double coarse = 0, fine = 0;
  EXPECT_LT(strayed(100, coarse), 1e-10);
  EXPECT_LT(strayed(200, fine), 1e-10);
  EXPECT_GT(coarse, 1e-6);               // the rate does vary
  EXPECT_NEAR(coarse / fine, 8.0, 1.0);  // third order in the time step
}

TEST(NavierStokes, AWindIsAMovingFrame) {
  const Planform wing = Planform::rectangle(1, 1.5, 0.25);
  const auto still = makeNavierStokes(wing, thinAir(), smallGrid());
  const auto blown = makeNavierStokes(wing, thinAir(), smallGrid());
  auto carried = [&](double t) {  // by a wind that rises
    const Wind wind{Vector3d(0.4, -0.3, 0.2) * t / 0.01, Vector3d(0.4, -0.3, 0.2) / 0.01};
    WingMotion m = flapping(t);
    m.v_W += m.R_IW.transpose() * wind.v;
    m.a_W += m.R_IW.transpose() * wind.a;
    return relativeTo(wind, m);
  };
  still->start(flapping(0), 0.01);
  blown->start(carried(0), 0.01);
  Loads a, b;
  for (int n = 1; n <= 5; ++n) {
    a = still->evaluate(flapping(n * 0.01));
    still->commit();
    b = blown->evaluate(carried(n * 0.01));
    blown->commit();
  }
  EXPECT_LT(relative(a, b, a.force().norm()), 1e-10);
}

TEST(NavierStokes, AWingAtRestInAirAtRestFeelsNothing) {
  const auto flow = makeNavierStokes(Planform::rectangle(1, 1, 0.5), thinAir(), smallGrid());
  flow->start(WingMotion{}, 0.01);
  const Loads l = flow->evaluate(WingMotion{});
  EXPECT_EQ(l.force().norm() + l.moment().norm(), 0.0);
}

/// Stokes' second problem in the middle of a large plate: error of the velocity profile.
double stokesError(int half_cells, int steps_per_period) {
  const double nu = 0.01, omega = 2 * M_PI, U = 1, k = std::sqrt(omega / (2 * nu));
  const double depth = 8 / k;  // the layer has died out there
  const int n = 24;
  const double size = 400;  // edges are out of reach: diffusion and potential flow are local
  std::vector<std::uint8_t> wing(n * n, 0);
  for (int j = 2; j < n - 2; ++j)
    for (int i = 2; i < n - 2; ++i) wing[j * n + i] = 1;
  Air air;
  air.rho = 1;
  air.mu = nu;
  const Axis z = layerAxis(depth, half_cells, size);
  NavierStokes flow(
      makeGrid(uniformAxis(-size, size, n), uniformAxis(-size, size, n), z, z.n() / 2, false, wing),
      air, 1.0, 100.0);
  const double dt = 1.0 / steps_per_period;
  auto motion = [&](double t) {
    WingMotion m;
    m.v_W = Vector3d(U * std::cos(omega * t), 0, 0);
    m.a_W = Vector3d(-U * omega * std::sin(omega * t), 0, 0);
    return m;
  };
  flow.start(motion(0), dt);
  const int steps = 3 * steps_per_period;
  for (int s = 1; s <= steps; ++s) {
    flow.evaluate(motion(s * dt));
    flow.commit();
  }
  double sum = 0;
  for (int kk = z.n() / 2 - half_cells; kk < z.n() / 2 + half_cells; ++kk) {
    const double kz = k * std::abs(z.centre[kk]);
    const double exact = U * std::exp(-kz) * std::cos(omega * steps * dt - kz);
    const double u = flow.velocity().c[0][flow.layout().at(n / 2, n / 2, kk)];
    sum += (u - exact) * (u - exact);
  }
  return std::sqrt(sum / (2 * half_cells));
}

TEST(NavierStokes, StokesSecondProblemIsOfSecondOrder) {
  const double coarse = stokesError(16, 24), fine = stokesError(32, 48);
  EXPECT_LT(fine, 0.01);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

}  // namespace
}  // namespace monarch_flight::fluid
