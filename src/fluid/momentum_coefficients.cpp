// Coefficients of the momentum step along rows, for the right side (CentralFace) and for the
// implicit factors (FactorFace).
#include "fluid/momentum.h"
#include "fluid/momentum_stencil.h"

namespace monarch_flight {

/// Stencils of the lower faces, along y or z, of the points of row (j, k).
template <class Face>
void Momentum::rowFaces(const Velocity& c, int component, int direction, int j, int k,
                        double* __restrict above, double* __restrict below) const {
  const std::ptrdiff_t o = -layout_.stride(component == direction ? direction : component);
  const double* __restrict f = c.c[direction].data() + layout_.at(0, j, k);
  const double inv_dist = metric_[component][direction].inverse_distance[direction == 1 ? j : k];
  const Face stencil(step_);
  for (int i = first(component, 0), end = last(component, 0); i <= end; ++i)
    stencil(0.5 * (f[i] + f[i + o]), inv_dist, above[i], below[i]);
}

template <class Face>
void Momentum::coefficientsX(const Velocity& c, int component, int j, int k, Row row) {
  const std::ptrdiff_t o = -layout_.stride(component);
  const double* __restrict f = c.c[0].data() + layout_.at(0, j, k);
  const double* __restrict inv_dist = metric_[component][0].inverse_distance.data();
  const double* __restrict iw = metric_[component][0].inverse_width.data();
  double* __restrict above = x_above_.data();
  double* __restrict below = x_below_.data();
  double* __restrict lower = row.lower;
  double* __restrict upper = row.upper;
  const int i0 = first(component, 0), i1 = last(component, 0);
  const Face stencil(step_);
  for (int i = i0; i <= i1 + 1; ++i)
    stencil(0.5 * (f[i] + f[i + o]), inv_dist[i], above[i], below[i]);
  for (int i = i0; i <= i1; ++i) {
    lower[i] = -iw[i] * above[i];
    upper[i] = iw[i] * below[i + 1];
  }
}

/// Rows of a plane come in ascending order: the upper faces of one are the lower faces of the next.
template <class Face>
void Momentum::coefficientsY(const Velocity& c, int component, int j, int k, Row row) {
  const std::ptrdiff_t here = (j % 2) * layout_.sy, next = layout_.sy - here;
  YFaces& faces = yFaces<Face>();
  double* above_faces = faces.above.data();
  double* below_faces = faces.below.data();
  if (j == first(component, 1))
    rowFaces<Face>(c, component, 1, j, k, above_faces + here, below_faces + here);
  rowFaces<Face>(c, component, 1, j + 1, k, above_faces + next, below_faces + next);
  const double* __restrict above = above_faces + here;
  const double* __restrict below = below_faces + next;
  double* __restrict lower = row.lower;
  double* __restrict upper = row.upper;
  const double iw = metric_[component][1].inverse_width[j];
  for (int i = first(component, 0), end = last(component, 0); i <= end; ++i) {
    lower[i] = -iw * above[i];
    upper[i] = iw * below[i];
  }
}

/// The stencil, `above` or `below`, of the face behind row (j, k) on the way upwards or downwards.
template <class Face>
void Momentum::faceBehindZ(const Velocity& c, int component, int j, int k, int towards,
                           double* behind) const {
  double* unused = next_.data();
  if (towards > 0) rowFaces<Face>(c, component, 2, j, k, behind, unused);
  if (towards < 0) rowFaces<Face>(c, component, 2, j, k + 1, unused, behind);
}

/// Rows of a line of z come one after the other: `behind` holds the stencil of the face behind the
/// row (j, k), and then that of the face ahead, for the next row.
template <class Face>
void Momentum::coefficientsZ(const Velocity& c, int component, int j, int k, int towards,
                             double* __restrict behind, Row row) const {
  const Direction& m = metric_[component][2];
  const int ahead = towards > 0 ? k + 1 : k;
  double* __restrict off_behind = towards > 0 ? row.lower : row.upper;
  double* __restrict off_ahead = towards > 0 ? row.upper : row.lower;
  double* __restrict next = next_.data();
  const double iw = towards * m.inverse_width[k];
  const int i0 = first(component, 0), i1 = last(component, 0);
  for (int i = i0; i <= i1; ++i) off_behind[i] = -iw * behind[i];
  towards > 0 ? rowFaces<Face>(c, component, 2, j, ahead, behind, next)
              : rowFaces<Face>(c, component, 2, j, ahead, next, behind);
  for (int i = i0; i <= i1; ++i) off_ahead[i] = iw * next[i];
}

#define MONARCH_FOR_FACE(Face)                                                                   \
  template void Momentum::rowFaces<Face>(const Velocity&, int, int, int, int, double*, double*)  \
      const;                                                                                     \
  template void Momentum::coefficientsX<Face>(const Velocity&, int, int, int, Row);              \
  template void Momentum::coefficientsY<Face>(const Velocity&, int, int, int, Row);              \
  template void Momentum::faceBehindZ<Face>(const Velocity&, int, int, int, int, double*) const; \
  template void Momentum::coefficientsZ<Face>(const Velocity&, int, int, int, int, double*, Row) \
      const;
MONARCH_FOR_FACE(CentralFace)
MONARCH_FOR_FACE(FactorFace)
#undef MONARCH_FOR_FACE

}  // namespace monarch_flight
