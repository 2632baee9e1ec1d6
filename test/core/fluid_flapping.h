#pragma once
// A small grid, thick air and a wing that flaps, for the tests of the flow solver.
#include <cmath>

#include "monarch_flight/fluid/navier_stokes.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {

inline GridSettings smallGrid() {
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
inline WingMotion flapping(double t) {
  const double w = 2 * M_PI, phi = 0.5 * std::sin(w * t), phid = 0.5 * w * std::cos(w * t),
               phidd = -0.5 * w * w * std::sin(w * t);
  const double th = 0.4 * std::cos(w * t), thd = -0.4 * w * std::sin(w * t),
               thdd = -0.4 * w * w * std::cos(w * t);
  WingMotion m;
  m.R_IW = rotationX(phi) * rotationY(th);
  m.omega_W = Eigen::Vector3d(phid * std::cos(th), thd, phid * std::sin(th));
  m.alpha_W = Eigen::Vector3d(phidd * std::cos(th) - phid * thd * std::sin(th), thdd,
                              phidd * std::sin(th) + phid * thd * std::cos(th));
  const Eigen::Vector3d velocity(0.5, 0.1, -0.2 * std::sin(w * t)),
      acceleration(0, 0, -0.2 * w * std::cos(w * t));
  m.v_W = m.R_IW.transpose() * velocity;
  m.a_W = m.R_IW.transpose() * acceleration;
  return m;
}

inline Air thinAir() {
  Air air;
  air.rho = 1.2;
  air.mu = 0.012;
  return air;
}

}  // namespace monarch_flight
