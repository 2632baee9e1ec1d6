#include "fluid/pressure/transform.h"

#include <algorithm>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {
namespace {

constexpr std::ptrdiff_t kBatchDoubles = 40000;  // 0.3 MB a buffer: two of them fit the L2 cache

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

PlaneTransform::PlaneTransform(const AxisModes& x, const AxisModes& y, int nz)
    : x_(x), y_(y), nz_(nz) {
  const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(x.n()) * y.n();
  batch_ = static_cast<int>(std::clamp<std::ptrdiff_t>(kBatchDoubles / plane, 1, nz));
  folded_.setZero(plane * batch_);
  halfway_.setZero(plane * batch_);
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

double* PlaneTransform::folded(int class_x, int class_y, int planes) const {
  const std::ptrdiff_t mx = x_.classes()[0].m(), my = y_.classes()[0].m();
  return folded_.data() + (class_x * y_.n() + class_y * my) * mx * planes;
}

double* PlaneTransform::halfway(int class_x, int class_y, int planes) const {
  return halfway_.data() + (folded(class_x, class_y, planes) - folded_.data());
}

void PlaneTransform::fold(const double* field, int k0, int planes) const {
  const int nx = x_.n(), ny = y_.n(), mx = x_.classes()[0].m(), my = y_.classes()[0].m();
  const std::ptrdiff_t row_stride = static_cast<std::ptrdiff_t>(planes) * mx;
  for (int k = 0; k < planes; ++k) {
    const double* plane = field + static_cast<std::ptrdiff_t>(k0 + k) * nx * ny;
    for (int j = 0; j < my; ++j) {
      const std::ptrdiff_t at = j * row_stride + static_cast<std::ptrdiff_t>(k) * mx;
      const double* row = plane + static_cast<std::ptrdiff_t>(j) * nx;
      const double* mirror = plane + static_cast<std::ptrdiff_t>(ny - 1 - j) * nx;
      if (x_.split() && y_.split()) {
        foldRowPair(row, mirror, mx, folded(0, 0, planes) + at, folded(1, 0, planes) + at,
                    folded(0, 1, planes) + at, folded(1, 1, planes) + at);
      } else if (x_.split()) {
        foldRow(row, mx, folded(0, 0, planes) + at, folded(1, 0, planes) + at);
      } else if (y_.split()) {
        double *even = folded(0, 0, planes) + at, *odd = folded(0, 1, planes) + at;
        for (int i = 0; i < nx; ++i) even[i] = row[i] + mirror[i];
        for (int i = 0; i < nx; ++i) odd[i] = row[i] - mirror[i];
      } else {
        std::copy(row, row + nx, folded(0, 0, planes) + at);
      }
    }
  }
}

void PlaneTransform::unfold(double* field, int k0, int planes) const {
  const int nx = x_.n(), ny = y_.n(), mx = x_.classes()[0].m(), my = y_.classes()[0].m();
  const std::ptrdiff_t row_stride = static_cast<std::ptrdiff_t>(planes) * mx;
  for (int k = 0; k < planes; ++k) {
    double* plane = field + static_cast<std::ptrdiff_t>(k0 + k) * nx * ny;
    for (int j = 0; j < my; ++j) {
      const std::ptrdiff_t at = j * row_stride + static_cast<std::ptrdiff_t>(k) * mx;
      double* row = plane + static_cast<std::ptrdiff_t>(j) * nx;
      double* mirror = plane + static_cast<std::ptrdiff_t>(ny - 1 - j) * nx;
      if (x_.split() && y_.split()) {
        unfoldRowPair(folded(0, 0, planes) + at, folded(1, 0, planes) + at,
                      folded(0, 1, planes) + at, folded(1, 1, planes) + at, mx, row, mirror);
      } else if (x_.split()) {
        unfoldRow(folded(0, 0, planes) + at, folded(1, 0, planes) + at, mx, row);
      } else if (y_.split()) {
        const double *even = folded(0, 0, planes) + at, *odd = folded(0, 1, planes) + at;
        for (int i = 0; i < nx; ++i) row[i] = even[i] + odd[i];
        for (int i = 0; i < nx; ++i) mirror[i] = even[i] - odd[i];
      } else {
        std::copy_n(folded(0, 0, planes) + at, nx, row);
      }
    }
  }
}

void PlaneTransform::forwardNegative(const double* field, double* spectrum) const {
  const int mx = x_.classes()[0].m();
  for (int k0 = 0; k0 < nz_; k0 += batch_) {
    const int planes = std::min(batch_, nz_ - k0);
    fold(field, k0, planes);
    for (std::size_t cx = 0; cx < x_.classes().size(); ++cx) {
      product(CblasTrans, CblasNoTrans, mx, planes * y_.n(), mx, 1.0,
              x_.classes()[cx].vectors.data(), mx, folded(cx, 0, planes), mx,
              halfway(cx, 0, planes), mx);
    }
    for (const SpectrumBlock& q : blocks_) {
      product(CblasNoTrans, CblasNoTrans, mx * planes, q.my, q.my, -1.0,
              halfway(q.class_x, q.class_y, planes), mx * planes,
              y_.classes()[q.class_y].vectors.data(), q.my,
              spectrum + q.offset + static_cast<std::ptrdiff_t>(k0) * mx, mx * nz_);
    }
  }
}

void PlaneTransform::inverse(const double* spectrum, double* field) const {
  const int mx = x_.classes()[0].m();
  for (int k0 = 0; k0 < nz_; k0 += batch_) {
    const int planes = std::min(batch_, nz_ - k0);
    for (const SpectrumBlock& q : blocks_) {
      product(CblasNoTrans, CblasTrans, mx * planes, q.my, q.my, 1.0,
              spectrum + q.offset + static_cast<std::ptrdiff_t>(k0) * mx, mx * nz_,
              y_.classes()[q.class_y].vectors.data(), q.my, halfway(q.class_x, q.class_y, planes),
              mx * planes);
    }
    for (std::size_t cx = 0; cx < x_.classes().size(); ++cx) {
      product(CblasNoTrans, CblasNoTrans, mx, planes * y_.n(), mx, 1.0,
              x_.classes()[cx].vectors.data(), mx, halfway(cx, 0, planes), mx,
              folded(cx, 0, planes), mx);
    }
    unfold(field, k0, planes);
  }
}

}  // namespace monarch_flight::fluid::pressure
