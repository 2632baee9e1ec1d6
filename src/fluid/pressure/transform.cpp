#include "fluid/pressure/transform.h"

#include <algorithm>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {
namespace {

constexpr std::ptrdiff_t kBatchDoubles = 40000;  // 0.3 MB a buffer: two of them fit the L2 cache
constexpr int kFewestBatches = 8;                // for threads; the same for any number of them

/// even[i] = row[i] + row[n-1-i], odd[i] = row[i] - row[n-1-i], i < m = n / 2.
void foldRow(const double* row, int m, double* even, double* odd) {
  const double* mirror = row + 2 * m - 1;
  for (int i = 0; i < m; ++i) {
    const double a = row[i], b = mirror[-i];
    even[i] = a + b;
    odd[i] = a - b;
  }
}

void foldRowPair(const double* row, const double* mirror_row, int m, double* even_even,
                 double* odd_even, double* even_odd, double* odd_odd) {
  const int last = 2 * m - 1;
  for (int i = 0; i < m; ++i) {
    const double a = row[i] + mirror_row[i], b = row[last - i] + mirror_row[last - i];
    const double c = row[i] - mirror_row[i], d = row[last - i] - mirror_row[last - i];
    even_even[i] = a + b;
    odd_even[i] = a - b;
    even_odd[i] = c + d;
    odd_odd[i] = c - d;
  }
}

void unfoldRow(const double* even, const double* odd, int m, double* row) {
  double* mirror = row + 2 * m - 1;
  for (int i = 0; i < m; ++i) {
    row[i] = even[i] + odd[i];
    mirror[-i] = even[i] - odd[i];
  }
}

void unfoldRowPair(const double* even_even, const double* odd_even, const double* even_odd,
                   const double* odd_odd, int m, double* row, double* mirror_row) {
  const int last = 2 * m - 1;
  for (int i = 0; i < m; ++i) {
    const double a = even_even[i] + even_odd[i], b = odd_even[i] + odd_odd[i];
    const double c = even_even[i] - even_odd[i], d = odd_even[i] - odd_odd[i];
    row[i] = a + b;
    row[last - i] = a - b;
    mirror_row[i] = c + d;
    mirror_row[last - i] = c - d;
  }
}

}  // namespace

PlaneTransform::PlaneTransform(const AxisModes& x, const AxisModes& y, int nz, const Team& team)
    : x_(x), y_(y), nz_(nz), team_(team) {
  const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(x.n()) * y.n();
  const int share = (nz + kFewestBatches - 1) / kFewestBatches;
  batch_ = static_cast<int>(std::clamp<std::ptrdiff_t>(kBatchDoubles / plane, 1, share));
  const Eigen::VectorXd empty = Eigen::VectorXd::Zero(plane * batch_);
  scratch_.assign(team.threads(), Scratch{empty, empty});
  std::ptrdiff_t offset = 0;
  int first_x = 0;
  for (int cx = 0; cx < static_cast<int>(x.classes().size()); ++cx) {
    const int mx = x.classes()[cx].m();
    int first_y = 0;
    for (int cy = 0; cy < static_cast<int>(y.classes().size()); ++cy) {
      const int my = y.classes()[cy].m();
      blocks_.push_back({offset, cx, cy, mx, my, first_x, first_y});
      offset += static_cast<std::ptrdiff_t>(mx) * my * nz;
      first_y += my;
    }
    first_x += mx;
  }
}

std::ptrdiff_t PlaneTransform::part(std::size_t class_x, std::size_t class_y, int planes) const {
  const std::ptrdiff_t mx = x_.classes()[0].m(), my = y_.classes()[0].m();
  return (static_cast<std::ptrdiff_t>(class_x) * y_.n() +
          static_cast<std::ptrdiff_t>(class_y) * my) *
         mx * planes;
}

void PlaneTransform::fold(const double* field, int k0, int planes, Scratch& s) const {
  const int nx = x_.n(), ny = y_.n(), mx = x_.classes()[0].m(), my = y_.classes()[0].m();
  auto folded = [&](int cx, int cy) { return s.folded.data() + part(cx, cy, planes); };
  const std::ptrdiff_t row_stride = static_cast<std::ptrdiff_t>(planes) * mx;
  for (int k = 0; k < planes; ++k) {
    const double* plane = field + static_cast<std::ptrdiff_t>(k0 + k) * nx * ny;
    for (int j = 0; j < my; ++j) {
      const std::ptrdiff_t at = j * row_stride + static_cast<std::ptrdiff_t>(k) * mx;
      const double* row = plane + static_cast<std::ptrdiff_t>(j) * nx;
      const double* mirror = plane + static_cast<std::ptrdiff_t>(ny - 1 - j) * nx;
      if (x_.split() && y_.split()) {
        foldRowPair(row, mirror, mx, folded(0, 0) + at, folded(1, 0) + at, folded(0, 1) + at,
                    folded(1, 1) + at);
      } else if (x_.split()) {
        foldRow(row, mx, folded(0, 0) + at, folded(1, 0) + at);
      } else if (y_.split()) {
        double *even = folded(0, 0) + at, *odd = folded(0, 1) + at;
        for (int i = 0; i < nx; ++i) even[i] = row[i] + mirror[i];
        for (int i = 0; i < nx; ++i) odd[i] = row[i] - mirror[i];
      } else {
        std::copy(row, row + nx, folded(0, 0) + at);
      }
    }
  }
}

void PlaneTransform::unfold(double* field, int k0, int planes, Scratch& s) const {
  const int nx = x_.n(), ny = y_.n(), mx = x_.classes()[0].m(), my = y_.classes()[0].m();
  auto folded = [&](int cx, int cy) { return s.folded.data() + part(cx, cy, planes); };
  const std::ptrdiff_t row_stride = static_cast<std::ptrdiff_t>(planes) * mx;
  for (int k = 0; k < planes; ++k) {
    double* plane = field + static_cast<std::ptrdiff_t>(k0 + k) * nx * ny;
    for (int j = 0; j < my; ++j) {
      const std::ptrdiff_t at = j * row_stride + static_cast<std::ptrdiff_t>(k) * mx;
      double* row = plane + static_cast<std::ptrdiff_t>(j) * nx;
      double* mirror = plane + static_cast<std::ptrdiff_t>(ny - 1 - j) * nx;
      if (x_.split() && y_.split()) {
        unfoldRowPair(folded(0, 0) + at, folded(1, 0) + at, folded(0, 1) + at, folded(1, 1) + at,
                      mx, row, mirror);
      } else if (x_.split()) {
        unfoldRow(folded(0, 0) + at, folded(1, 0) + at, mx, row);
      } else if (y_.split()) {
        const double *even = folded(0, 0) + at, *odd = folded(0, 1) + at;
        for (int i = 0; i < nx; ++i) row[i] = even[i] + odd[i];
        for (int i = 0; i < nx; ++i) mirror[i] = even[i] - odd[i];
      } else {
        std::copy_n(folded(0, 0) + at, nx, row);
      }
    }
  }
}

void PlaneTransform::forwardNegative(const double* field, double* spectrum) const {
  const int mx = x_.classes()[0].m();
  team_.each(0, (nz_ + batch_ - 1) / batch_, [&](int batch, int thread) {
    const int k0 = batch * batch_, planes = std::min(batch_, nz_ - k0);
    Scratch& s = scratch_[thread];
    fold(field, k0, planes, s);
    for (std::size_t cx = 0; cx < x_.classes().size(); ++cx) {
      product(CblasTrans, CblasNoTrans, mx, planes * y_.n(), mx, 1.0,
              x_.classes()[cx].vectors.data(), mx, s.folded.data() + part(cx, 0, planes), mx,
              s.halfway.data() + part(cx, 0, planes), mx);
    }
    for (const SpectrumBlock& q : blocks_) {
      product(CblasNoTrans, CblasNoTrans, mx * planes, q.my, q.my, -1.0,
              s.halfway.data() + part(q.class_x, q.class_y, planes), mx * planes,
              y_.classes()[q.class_y].vectors.data(), q.my,
              spectrum + q.offset + static_cast<std::ptrdiff_t>(k0) * mx, mx * nz_);
    }
  });
}

void PlaneTransform::inverse(const double* spectrum, double* field, int begin, int end) const {
  const int mx = x_.classes()[0].m();
  if (begin >= end) return;
  const int size = std::min(batch_, (end - begin + kFewestBatches - 1) / kFewestBatches);
  team_.each(0, (end - begin + size - 1) / size, [&](int batch, int thread) {
    const int k0 = begin + batch * size, planes = std::min(size, end - k0);
    Scratch& s = scratch_[thread];
    for (const SpectrumBlock& q : blocks_) {
      product(CblasNoTrans, CblasTrans, mx * planes, q.my, q.my, 1.0,
              spectrum + q.offset + static_cast<std::ptrdiff_t>(k0) * mx, mx * nz_,
              y_.classes()[q.class_y].vectors.data(), q.my,
              s.halfway.data() + part(q.class_x, q.class_y, planes), mx * planes);
    }
    for (std::size_t cx = 0; cx < x_.classes().size(); ++cx) {
      product(CblasNoTrans, CblasNoTrans, mx, planes * y_.n(), mx, 1.0,
              x_.classes()[cx].vectors.data(), mx, s.halfway.data() + part(cx, 0, planes), mx,
              s.folded.data() + part(cx, 0, planes), mx);
    }
    unfold(field, k0, planes, s);
  });
}

}  // namespace monarch_flight::fluid::pressure
