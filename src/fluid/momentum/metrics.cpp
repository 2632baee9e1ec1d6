#include "fluid/momentum/metrics.h"

namespace monarch_flight::fluid::momentum {

Metrics::Metrics(const Grid& g, const Layout& l) : grid(g), layout(l), rim(g, l) {
  zero.assign(layout.sy, 0.0);
  const Axis* axes[3] = {&grid.x, &grid.y, &grid.z};
  for (int c = 0; c < 3; ++c) {
    for (int d = 0; d < 3; ++d) {
      const Axis& along = *axes[d];
      const int n = along.n(), start = c == d ? 1 : 0;
      Direction& m = axis[c][d];
      m.inverse_width.assign(n + 2, 0.0);
      m.inverse_distance.assign(n + 2, 0.0);
      for (int i = start; i < n; ++i)
        m.inverse_width[i] = 1 / (c == d ? along.gap[i] : along.width[i]);
      for (int i = start; i <= n; ++i)
        m.inverse_distance[i] = 1 / (c == d ? along.width[i - 1] : along.gap[i]);
    }
    fourth_x[c].assign(layout.sy, 0.0);
    for (int i = 2 + (c == 0); i <= layout.nx - 3; ++i)
      fourth_x[c][i] = axis[c][0].inverse_width[i];
  }
}

}  // namespace monarch_flight::fluid::momentum
