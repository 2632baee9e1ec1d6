#pragma once
#include "fluid/fields/frame.h"
#include "fluid/momentum/metrics.h"
#include "fluid/momentum/stencil.h"

namespace monarch_flight::fluid::momentum {

/// Rows [first, last] of a plane, points [i0, i1] of each.
struct LineRange {
  int first, last, i0, i1;
  bool empty() const { return first > last || i0 > i1; }
};

/// The z factor of one component,  (1 + a A_z) delta = side:  eliminated from both ends to the
/// wing's plane, solved there, substituted outwards; v* = v^n + delta. Half 0 are the planes below
/// the wing's, half 1 those above it (k_wing and more). Lines do not know each other.
struct Lines {
  const Metrics& m;
  const MomentumStep& step;
  const Velocity& c;  ///< convecting field
  int component;
  const double* side;  ///< right sides (layout of the fields)
  double* reduced;     ///< what the elimination makes of them; may be the same
  double* gamma;       ///< off-diagonal left after elimination, of the point (0, 0, 0)
  std::ptrdiff_t gamma_row, gamma_plane;  ///< its strides of j and k
  double* behind;                         ///< one plane: stencils of the faces behind a row
  double* solved[2];                      ///< one plane a half: the solution, as it goes outwards
  const double* level;                    ///< v^n
  double* out;                            ///< v*

  /// Of a half: its plane farthest from the wing, and that beside the wing, on this process.
  int outermost(int half) const { return half == 0 ? m.first(component, 2) : m.last(component, 2); }
  int innermost(int half) const {
    return half == 0 ? std::min(m.last(component, 2), m.grid.k_wing - 1)
                     : std::max(m.first(component, 2), m.grid.k_wing);
  }
  /// Planes `begin` to `end` of a half, towards the wing; those beside it see the change of the
  /// wall's velocity.
  void eliminate(const LineRange& range, int half, int begin, int end,
                 const WallVelocity& wall_change) const;
  /// The two points that meet at the wing's plane, of which this process owns one or both.
  void join(const LineRange& range) const;
  void substitute(const LineRange& range, int half) const;

 private:
  double* gammaAt(int j, int k) const { return gamma + j * gamma_row + k * gamma_plane; }
  double* solvedAt(int half, int j) const { return solved[half] + (j + 1) * m.layout.sy + 8; }
  double* behindAt(int j) const { return behind + (j + 1) * m.layout.sy + 8; }
  void firstFaces(const LineRange& range, int j, int k, int towards) const;
  void eliminateRow(const LineRange& range, int j, int k, int towards,
                    const WallVelocity& wall_change) const;
};

}  // namespace monarch_flight::fluid::momentum
