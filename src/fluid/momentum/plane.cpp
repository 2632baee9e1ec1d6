// The x and y factors, plane by plane.
#include <algorithm>

#include "fluid/momentum/interleave.h"
#include "fluid/momentum/momentum.h"

namespace monarch_flight::fluid::momentum {

void Momentum::fixWingFaces(const WallVelocity& wall_change, int j, Row row, double* d) const {
  for (int i = 0; i < layout_.nx; ++i) {
    if (!grid_.isWing(i, j)) continue;
    row.lower[i] = row.upper[i] = 0;
    d[i] = wall_change.at(2, grid_.x.centre[i], grid_.y.centre[j]);
  }
}

/// Thomas' algorithm along x for up to eight neighbouring rows, one in each lane.
void Momentum::sweepX(int component, double* rows, int lines) {
  const int i0 = first(component, 0), i1 = last(component, 0), n = i1 + 1;
  double* __restrict g = lane_gamma_.data();
  double* __restrict d = lane_side_.data();
  const double* __restrict lo = lane_lower_.data();
  const double* __restrict up = lane_upper_.data();
  interleave(x_lower_.data(), layout_.sy, lines, n, lane_lower_.data());
  interleave(x_upper_.data(), layout_.sy, lines, n, lane_upper_.data());
  interleave(rows, layout_.sy, lines, n, d);
  for (int l = 0; l < kLines; ++l) {
    const int q = i0 * kLines + l;
    const double inv = 1 / (1 - lo[q] - up[q]);
    g[q] = up[q] * inv;
    d[q] *= inv;
  }
  for (int i = i0 + 1; i <= i1; ++i) {
    for (int l = 0; l < kLines; ++l) {
      const int q = i * kLines + l, before = q - kLines;
      const double inv = 1 / (1 - lo[q] - up[q] - lo[q] * g[before]);
      g[q] = up[q] * inv;
      d[q] = (d[q] - lo[q] * d[before]) * inv;
    }
  }
  for (int q = i1 * kLines - 1; q >= i0 * kLines; --q) d[q] -= g[q] * d[q + kLines];
  separate(d, lines, n, rows, layout_.sy);
}

/// One row of the elimination along y; rows of a plane in ascending order.
void Momentum::eliminateY(int component, int j, Row row, double* __restrict d) {
  const int i0 = first(component, 0), i1 = last(component, 0);
  const bool is_end = j == first(component, 1);
  const double* __restrict lo = row.lower;
  const double* __restrict up = row.upper;
  double* __restrict g = gamma_.data() + j * layout_.sy;
  const double* __restrict g_before = is_end ? zero_.data() : g - layout_.sy;
  const double* __restrict d_before = is_end ? zero_.data() : d - layout_.sy;
  for (int i = i0; i <= i1; ++i) {
    const double inv = 1 / (1 - lo[i] - up[i] - lo[i] * g_before[i]);
    g[i] = up[i] * inv;
    d[i] = (d[i] - lo[i] * d_before[i]) * inv;
  }
}

void Momentum::substituteY(int component, int k) {
  const int i0 = first(component, 0), i1 = last(component, 0);
  for (int j = last(component, 1) - 1; j >= first(component, 1); --j) {
    double* __restrict d = delta_.c[component].data() + layout_.at(0, j, k);
    const double* __restrict g = gamma_.data() + j * layout_.sy;
    const double* __restrict above = d + layout_.sy;
    for (int i = i0; i <= i1; ++i) d[i] -= g[i] * above[i];
  }
}

void Momentum::solveRows(int component, int j, int k, int lines) {
  double* rows = delta_.c[component].data() + layout_.at(0, j, k);
  sweepX(component, rows, lines);
  for (int l = 0; l < lines; ++l) eliminateY(component, j + l, yRow(l), rows + l * layout_.sy);
}

}  // namespace monarch_flight::fluid::momentum
