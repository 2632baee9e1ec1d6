#pragma once
// Models, motions and loads that the tests of the blade-element model share.
#include <cmath>
#include <random>

#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {

constexpr auto kSane = BladeElementVariant::kSaneDickinson;
constexpr auto kWhitney = BladeElementVariant::kWhitneyWood;

inline Air air() { return Air{}; }
inline double rho() { return air().rho; }

inline Loads loadsOf(FluidModel& model, const WingMotion& motion) {
  model.start(WingMotion{}, 1e-3);
  return model.evaluate(motion);
}

inline Vector6d wrench(const Loads& loads) {
  Vector6d w;
  w << loads.force(), loads.moment();
  return w;
}

/// A wing that moves with constant velocity in its own plane x-z, `alpha` ventral of forward.
inline WingMotion translation(double speed, double alpha) {
  WingMotion m;
  m.v_W = Eigen::Vector3d(speed * std::cos(alpha), 0.0, speed * std::sin(alpha));
  return m;
}

inline WingMotion randomMotion(std::mt19937& generator) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const auto vector = [&](double scale) {
    return Eigen::Vector3d(scale * Eigen::Vector3d(u(generator), u(generator), u(generator)));
  };
  WingMotion m;
  m.R_IW = expSO3(vector(2.0));
  m.v_W = vector(3.0);
  m.omega_W = vector(60.0);
  m.a_W = vector(200.0);
  m.alpha_W = vector(5e3);
  return m;
}

}  // namespace monarch_flight
