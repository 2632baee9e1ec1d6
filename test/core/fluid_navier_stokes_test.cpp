// The flow solver against exact solutions, its affine property and its repeatability.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/flow.h"
#include "fluid/projection.h"
#include "monarch_flight/fluid/navier_stokes.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

using Eigen::Matrix3d;
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

GridSettings smallGrid() {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = 8;
  s.first_cell = 0.06;
  s.far_field = 4;
  s.courant_limit = 10;
  return s;
}

/// A wing that flaps, pitches and translates: analytic position and attitude, rates by its own
/// algebra.
WingMotion flapping(double t) {
  const double w = 2 * M_PI, phi = 0.5 * std::sin(w * t), phid = 0.5 * w * std::cos(w * t),
               phidd = -0.5 * w * w * std::sin(w * t);
  const double th = 0.4 * std::cos(w * t), thd = -0.4 * w * std::sin(w * t),
               thdd = -0.4 * w * w * std::cos(w * t);
  WingMotion m;
  m.R_IW = rotationX(phi) * rotationY(th);
  m.omega_W = Vector3d(phid * std::cos(th), thd, phid * std::sin(th));
  m.alpha_W = Vector3d(phidd * std::cos(th) - phid * thd * std::sin(th), thdd,
                       phidd * std::sin(th) + phid * thd * std::cos(th));
  const Vector3d velocity(0.5, 0.1, -0.2 * std::sin(w * t)),
      acceleration(0, 0, -0.2 * w * std::cos(w * t));
  m.v_W = m.R_IW.transpose() * velocity;
  m.a_W = m.R_IW.transpose() * acceleration;
  return m;
}

Air thinAir() {
  Air air;
  air.rho = 1.2;
  air.mu = 0.012;
  return air;
}

double relative(const Loads& a, const Loads& b, double scale) {
  return ((a.force() - b.force()).norm() + (a.moment() - b.moment()).norm()) / scale;
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
    const Vector3d expected = motion(n).R_IW.transpose() * stream;
    double worst = 0;
    const Layout& l = flow.layout();
    for (int k = 0; k < l.nz; ++k)
      for (int j = 0; j < l.ny; ++j)
        for (int i = 0; i < l.nx; ++i)
          for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(flow.velocity().c[c][l.at(i, j, k)] - expected[c]));
    EXPECT_LT(worst, 1e-10 * stream.norm()) << "step " << n;
  }
}

class FlappingPlate : public ::testing::Test {
 protected:
  FlappingPlate()
      : flow_(makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid())) {
    flow_->start(flapping(0), kDt);
  }
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) {
      flow_->evaluate(flapping(++step_ * kDt));
      flow_->commit();
    }
  }
  WingMotion next() const { return flapping((step_ + 1) * kDt); }

  static constexpr double kDt = 0.005;
  int step_ = 0;
  std::unique_ptr<FluidModel> flow_;
};

WingMotion moved(WingMotion m, const Vector6d& du) {
  m.v_W += du.head<3>();
  m.omega_W += du.tail<3>();
  return m;
}

TEST_F(FlappingPlate, LoadsAreAffineInTheInterfaceVelocity) {
  for (int stop : {1, 12}) {
    advance(stop);
    const WingMotion base = next();
    const Loads l0 = flow_->evaluate(base);
    Matrix6d K;
    for (int i = 0; i < 6; ++i) {
      const Loads l = flow_->evaluate(moved(base, Vector6d::Unit(i)));
      K.col(i) << l.force() - l0.force(), l.moment() - l0.moment();
    }
    Vector6d du;
    du << 0.3, -0.5, 0.7, -0.2, 0.4, 0.6;
    const Loads l = flow_->evaluate(moved(base, du));
    Vector6d predicted = K * du, found;
    predicted.head<3>() += l0.force();
    predicted.tail<3>() += l0.moment();
    found << l.force(), l.moment();
    EXPECT_LT((predicted - found).norm(), 1e-11 * found.norm());
    // K's normal block is the added mass times the time scheme's leading coefficient, and
    // viscosity.
    const double lead = stop == 1 ? 1.5 / kDt : 1.5 / kDt;
    const Matrix6d M = flow_->addedMass();
    EXPECT_NEAR(-K(2, 2) / lead / M(2, 2), 1.0, 0.05);
    EXPECT_NEAR(-K(3, 3) / lead / M(3, 3), 1.0, 0.05);
    EXPECT_LT(std::abs(K(2, 3) - K(3, 2)), 0.02 * std::sqrt(K(2, 2) * K(3, 3)));
  }
}

TEST_F(FlappingPlate, LoadOperatorPredictsTheLoadsOfTheStep) {
  advance(3);
  LoadOperator jacobian;
  const Loads base = flow_->evaluate(next()), with = flow_->linearise(next(), jacobian);
  EXPECT_EQ(base.force(), with.force());
  EXPECT_EQ(base.moment(), with.moment());
  EXPECT_TRUE(jacobian.acceleration.isZero(0.0));
  Vector6d du, predicted, found;
  du << 0.3, -0.5, 0.7, -0.2, 0.4, 0.6;
  const Loads l = flow_->evaluate(moved(next(), du));
  predicted << base.force(), base.moment();
  predicted += jacobian.velocity * du;
  found << l.force(), l.moment();
  EXPECT_LT((predicted - found).norm(), 1e-10 * found.norm());
  // What is committed after it is the step at `next`, not one of the unit evaluations.
  const auto plain = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  plain->restore(flow_->save());
  plain->evaluate(next());
  plain->commit();
  flow_->linearise(next(), jacobian);
  flow_->commit();
  EXPECT_TRUE(plain->save() == flow_->save());
}

TEST_F(FlappingPlate, AStepRestoredAHundredTimesIsTheSameStep) {
  advance(2);
  const std::vector<char> before = flow_->save();
  const Loads first = flow_->evaluate(next());
  flow_->commit();
  const std::vector<char> after = flow_->save();
  for (int i = 0; i < 100; ++i) {
    flow_->restore(before);
    if (i % 10 == 0) flow_->evaluate(moved(next(), Vector6d::Constant(0.1 * i)));
    const Loads again = flow_->evaluate(next());
    ASSERT_EQ(first.force(), again.force()) << "repetition " << i;
    ASSERT_EQ(first.moment(), again.moment());
    flow_->commit();
    ASSERT_TRUE(flow_->save() == after) << "repetition " << i;
  }
}

TEST_F(FlappingPlate, EvaluationsArePureAndStateIsRestoredBitwise) {
  advance(3);
  const WingMotion base = next();
  const Loads first = flow_->evaluate(base);
  flow_->evaluate(moved(base, Vector6d::Ones()));
  const Loads again = flow_->evaluate(base);
  EXPECT_EQ(first.force(), again.force());
  EXPECT_EQ(first.moment(), again.moment());

  const std::vector<char> prepared = flow_->save();
  flow_->commit();
  const Loads ahead = flow_->evaluate(flapping((step_ + 2) * kDt));
  flow_->restore(prepared);
  EXPECT_EQ(first.force(), flow_->evaluate(base).force());
  flow_->commit();
  const std::vector<char> committed = flow_->save();
  const auto other = makeNavierStokes(Planform::ellipse(1.0, 2.0, 0.3), thinAir(), smallGrid());
  other->restore(committed);
  const Loads elsewhere = other->evaluate(flapping((step_ + 2) * kDt));
  EXPECT_EQ(ahead.force(), elsewhere.force());
  EXPECT_EQ(ahead.moment(), elsewhere.moment());
}

TEST_F(FlappingPlate, LoadsDoNotAlternateFromStepToStep) {
  std::vector<double> f;
  for (int i = 0; i < 100; ++i) {
    const Loads l = flow_->evaluate(next());
    advance(1);
    f.push_back(l.force().z());
  }
  double rms = 0, noise = 0;
  for (std::size_t i = 20; i + 4 < f.size(); ++i) {
    rms += f[i] * f[i];
    const double d4 = (f[i] - 4 * f[i + 1] + 6 * f[i + 2] - 4 * f[i + 3] + f[i + 4]) / 16;
    noise += d4 * d4;
  }
  EXPECT_LT(std::sqrt(noise / rms), 1e-4);
}

TEST_F(FlappingPlate, VelocityIsFreeOfDivergenceAndMeetsTheWall) {
  auto& flow = dynamic_cast<NavierStokes&>(*flow_);
  advance(5);
  EXPECT_LT(relativeDivergence(flow.grid(), flow.layout(), flow.velocity()), 1e-11);
  EXPECT_GT(flow.report().divergence, 0);  // of rounding: it was taken
  EXPECT_LT(flow.report().divergence, 1e-11);
  const WingMotion now = flapping(step_ * kDt);
  const Grid& g = flow.grid();
  for (int j = 0; j < g.y.n(); ++j)
    for (int i = 0; i < g.x.n(); ++i) {
      if (!g.isWing(i, j)) continue;
      const Vector3d wall = now.v_W + now.omega_W.cross(Vector3d(g.x.centre[i], g.y.centre[j], 0));
      ASSERT_NEAR(flow.velocity().c[2][flow.layout().at(i, j, g.k_wing)], wall.z(), 1e-13);
    }
}

TEST_F(FlappingPlate, BadStepsEndWithAReason) {
  EXPECT_THROW(flow_->commit(), std::logic_error);
  WingMotion bad = next();
  bad.v_W.x() = std::nan("");
  EXPECT_THROW(flow_->evaluate(bad), NumericalError);
  std::vector<char> state = flow_->save();
  state.pop_back();
  EXPECT_THROW(flow_->restore(state), std::invalid_argument);
}

TEST(NavierStokes, ACourantNumberAboveTheLimitEndsTheRun) {
  GridSettings s = smallGrid();
  s.courant_limit = 0.01;
  const auto flow = makeNavierStokes(Planform::rectangle(1, 2, 0.5), thinAir(), s);
  flow->start(flapping(0.1), 0.01);
  try {
    flow->evaluate(flapping(0.11));
    flow->commit();
    flow->evaluate(flapping(0.12));
    FAIL() << "no error";
  } catch (const NumericalError& e) {
    EXPECT_NE(std::string(e.what()).find("courant_limit"), std::string::npos);
  }
}

TEST(NavierStokes, AWindIsAMovingFrame) {
  const Planform wing = Planform::rectangle(1, 1.5, 0.25);
  Air windy = thinAir();
  windy.wind_I = Vector3d(0.4, -0.3, 0.2);
  const auto still = makeNavierStokes(wing, thinAir(), smallGrid());
  const auto blown = makeNavierStokes(wing, windy, smallGrid());
  auto carried = [&](double t) {
    WingMotion m = flapping(t);
    m.v_W += m.R_IW.transpose() * windy.wind_I;
    return m;
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
}  // namespace monarch_flight
