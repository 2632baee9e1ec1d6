// Fields for pictures and files: what surrounds the wing at the committed level.
#include <stdexcept>

#include "fluid/fields/gathered.h"
#include "fluid/flow/derived.h"
#include "fluid/flow/flow.h"
#include "fluid/loads/wing_loads.h"

namespace monarch_flight::fluid {
void NavierStokes::requireCommitted() const {
  if (prepared_) {
    throw std::logic_error(
        "Navier-Stokes: velocities are those of the committed level, not to be had between "
        "evaluate and commit");
  }
}

Eigen::Vector3d NavierStokes::velocityAt(int i, int j, int k) const {
  const std::ptrdiff_t q = layout_.at(i, j, k);
  Eigen::Vector3d v;
  for (int c = 0; c < 3; ++c) {
    v[c] = 0.5 * (vn_.c[c][q] + vn_.c[c][q + layout_.stride(c)]);
  }
  return v;
}

/// g(c, d) = d v_c / d x_d at the centre of a cell. Differences along z end at the wing: there the
/// air has the wall's velocity.
Eigen::Matrix3d NavierStokes::gradientAt(int i, int j, int k) const {
  const Axis* axes[3] = {&grid_.x, &grid_.y, &grid_.z};
  const int at[3] = {i, j, k};
  const std::ptrdiff_t q = layout_.at(i, j, k);
  const bool wing = grid_.isWing(i, j);
  const bool above = wing && k == grid_.k_wing, below = wing && k == grid_.k_wing - 1;
  Eigen::Matrix3d g;
  for (int c = 0; c < 3; ++c) {
    const double* v = vn_.c[c].data() + q;
    const std::ptrdiff_t sc = layout_.stride(c);
    for (int d = 0; d < 3; ++d) {
      const std::ptrdiff_t s = layout_.stride(d);
      const Axis& a = *axes[d];
      if (c == d) {
        g(c, d) = (v[s] - v[0]) / a.width[at[d]];
        continue;
      }
      double low = 0.5 * (v[-s] + v[-s + sc]), high = 0.5 * (v[s] + v[s + sc]);
      double low_gap = a.gap[at[d]], high_gap = a.gap[at[d] + 1];
      if (d == 2 && (above || below)) {
        const double wall = level_n_.wall.at(c, grid_.x.centre[i], grid_.y.centre[j]);
        (above ? low : high) = wall;
        (above ? low_gap : high_gap) = 0.5 * a.width[k];
      }
      g(c, d) = (high - low) / (low_gap + high_gap);
    }
  }
  return g;
}

SurfacePressure NavierStokes::surfacePressure() const {
  std::vector<SurfacePressure::Facet> facets;
  const loads::WingPressure p(grid_, layout_, p_.data(), nullptr);
  for (int j = 0; slab_.owns(grid_.k_wing) && j < layout_.ny; ++j) {
    for (int i = 0; i < layout_.nx; ++i) {
      if (!grid_.isWing(i, j)) continue;
      const double x = grid_.x.centre[i], y = grid_.y.centre[j],
                   a_n = committed_acceleration_.at(2, x, y);
      facets.push_back({float(x), float(y), float(grid_.x.width[i]), float(grid_.y.width[j]),
                        float(p.below(i, j, air_.rho, a_n)), float(p.above(i, j, air_.rho, a_n))});
    }
  }
  return {gathered(slab_, facets)};
}

/// Mean over a face of the wing of the friction on a side (0: plane k_wing - 1), by the same shares
/// of the points beside it as in the loads: those on the rim belong to this face alone.
double NavierStokes::frictionAt(int component, int i, int j, int side) const {
  const momentum::Metrics& m = momentum_.metrics();
  const int k = grid_.k_wing - 1 + side;
  const Axis& own = component == 0 ? grid_.x : grid_.y;
  const int cell = component == 0 ? i : j;
  double sum = 0;
  for (int d : {0, 1}) {
    const int a = i + (component == 0 ? d : 0), b = j + (component == 1 ? d : 0);
    const int next = cell + 2 * d - 1;
    const bool shared = next >= 0 && next < own.n() &&
                        (component == 0 ? grid_.isWing(next, j) : grid_.isWing(i, next));
    const double slip = vn_.c[component][layout_.at(a, b, k)] -
                        level_n_.wall.at(component, m.x(component, a), m.y(component, b));
    sum += (shared ? 0.5 : 1.0) * m.rim.wall(component, side, b)[a] * own.gap[cell + d] * slip;
  }
  return air_.mu * sum / (0.5 * grid_.z.width[k] * own.width[cell]);
}

std::vector<FlowField::WingFace> NavierStokes::wingFaces() const {
  std::vector<FlowField::WingFace> faces;
  const int kw = grid_.k_wing;
  const loads::WingPressure p(grid_, layout_, p_.data(), nullptr);
  for (int j = 0; slab_.owns(kw) && j < layout_.ny; ++j) {
    for (int i = 0; i < layout_.nx; ++i) {
      if (!grid_.isWing(i, j)) continue;
      const double x = grid_.x.centre[i], y = grid_.y.centre[j],
                   a_n = committed_acceleration_.at(2, x, y);
      FlowField::WingFace f{float(x),
                            float(y),
                            float(grid_.x.width[i]),
                            float(grid_.y.width[j]),
                            float(p.below(i, j, air_.rho, a_n)),
                            float(p.above(i, j, air_.rho, a_n)),
                            {0, 0},
                            {0, 0}};
      for (int c : {0, 1}) {
        f.friction_upper[c] = float(frictionAt(c, i, j, 0));
        f.friction_lower[c] = float(frictionAt(c, i, j, 1));
      }
      faces.push_back(f);
    }
  }
  return gathered(slab_, faces);
}

std::shared_ptr<const FlowField> NavierStokes::flowField() const {
  requireCommitted();
  FlowField mine;
  const auto put = [](std::vector<float>& to, const Eigen::Vector3d& v) {
    to.insert(to.end(), {float(v.x()), float(v.y()), float(v.z())});
  };
  for (int k = layout_.k0; k < layout_.k1; ++k) {
    for (int j = 0; j < layout_.ny; ++j) {
      for (int i = 0; i < layout_.nx; ++i) {
        const Eigen::Matrix3d g = gradientAt(i, j, k);
        put(mine.velocity, velocityAt(i, j, k));
        put(mine.vorticity, curl(g));
        mine.pressure.push_back(float(p_[layout_.at(i, j, k)]));
        mine.q.push_back(float(secondInvariant(g)));
      }
    }
  }
  auto whole = std::make_shared<FlowField>();
  for (auto part :
       {&FlowField::velocity, &FlowField::vorticity, &FlowField::pressure, &FlowField::q}) {
    (*whole).*part = gathered(slab_, mine.*part);
  }
  whole->x = grid_.x.face;
  whole->y = grid_.y.face;
  whole->z = grid_.z.face;
  whole->wing = wingFaces();
  return whole;
}

}  // namespace monarch_flight::fluid
