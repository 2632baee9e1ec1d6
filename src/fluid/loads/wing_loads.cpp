#include "fluid/loads/wing_loads.h"

#include <algorithm>

namespace monarch_flight::fluid::loads {

void pressureLoads(const Grid& grid, const Layout& l, const WingPressure& p, double rho,
                   const WallVelocity& acceleration, Loads& loads) {
  const bool below = grid.k_wing - 1 >= l.k0 && grid.k_wing - 1 < l.k1;
  const bool above = grid.k_wing >= l.k0 && grid.k_wing < l.k1;
  double f = 0, mx = 0, my = 0;
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      if (!grid.isWing(i, j)) continue;
      const double x = grid.x.centre[i], y = grid.y.centre[j];
      const double a_n = acceleration.at(2, x, y);
      double jump = 0;
      if (below) jump += p.below(i, j, rho, a_n);
      if (above) jump -= p.above(i, j, rho, a_n);
      const double df = grid.x.width[i] * grid.y.width[j] * jump;
      f += df;
      mx += y * df;
      my -= x * df;
    }
  }
  loads.force_pressure = {0, 0, f};
  loads.moment_pressure = {mx, my, 0};
}

void frictionLoads(const Grid& grid, const Layout& l, const momentum::Metrics& metrics,
                   const Velocity& v, const double* phi, double scale, const WallVelocity& wall,
                   double mu, Loads& loads) {
  const int kw = grid.k_wing;
  const std::ptrdiff_t pz = static_cast<std::ptrdiff_t>(l.nx) * l.ny;
  double f[2] = {0, 0}, mz = 0;
  for (int c = 0; c < 2; ++c) {
    const Axis& own = c == 0 ? grid.x : grid.y;
    const std::ptrdiff_t s = c == 0 ? 1 : l.nx;
    for (int j = c == 1; j < l.ny; ++j) {
      for (int i = c == 0; i < l.nx; ++i) {
        if (metrics.rim.cut(c, 0, j)[i] == 0) continue;
        const double x = c == 0 ? grid.x.face[i] : grid.x.centre[i];
        const double y = c == 1 ? grid.y.face[j] : grid.y.centre[j];
        const double gap = own.gap[c == 0 ? i : j];
        const double area = gap * (c == 0 ? grid.y.width[j] : grid.x.width[i]);
        const double u_wall = wall.at(c, x, y);
        double df = 0;
        for (int k = std::max(kw - 1, l.k0); k <= std::min(kw, l.k1 - 1); ++k) {
          const double* q = phi + (k - l.k0) * pz + static_cast<std::ptrdiff_t>(j) * l.nx + i;
          const double u =
              v.c[c][l.at(i, j, k)] - grid.mobility.at(c, i, j, k) * scale / gap * (q[0] - q[-s]);
          const double seen = metrics.rim.wall(c, k - kw + 1, j)[i];
          df += mu * (u - u_wall) / (0.5 * grid.z.width[k]) * seen * area;
        }
        f[c] += df;
        mz += c == 0 ? -y * df : x * df;
      }
    }
  }
  loads.force_friction = {f[0], f[1], 0};
  loads.moment_friction = {0, 0, mz};
}

void rimLoads(const Grid& grid, const Layout& l, const momentum::Momentum& momentum,
              const Velocity& convecting, const Velocity& v_star, double rho_by_a, double* row,
              Loads& loads) {
  if (grid.k_wing < l.k0 || grid.k_wing >= l.k1) return;
  double f = 0, mx = 0, my = 0;
  for (int j = 0; j < l.ny; ++j) {
    const std::uint8_t* wing = grid.wing.data() + static_cast<std::size_t>(j) * l.nx;
    if (std::find(wing, wing + l.nx, 1) == wing + l.nx) continue;
    momentum::normalTransport(momentum.metrics(), momentum.step(), convecting, v_star, j, row);
    const double side = rho_by_a * grid.z.gap[grid.k_wing] * grid.y.width[j];
    for (int i = 0; i < l.nx; ++i) {
      const double df = -side * grid.x.width[i] * row[i];
      f += df;
      mx += grid.y.centre[j] * df;
      my -= grid.x.centre[i] * df;
    }
  }
  loads.force_friction.z() += f;
  loads.moment_friction.x() += mx;
  loads.moment_friction.y() += my;
}

void sumLoads(const Slab& slab, Loads& loads) {
  double all[12];
  Eigen::Map<Eigen::Matrix<double, 3, 4>> m(all);
  m << loads.force_pressure, loads.force_friction, loads.moment_pressure, loads.moment_friction;
  slab.sum(all, 12);
  loads = {m.col(0), m.col(1), m.col(2), m.col(3)};
}

}  // namespace monarch_flight::fluid::loads
