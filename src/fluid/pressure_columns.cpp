#include "fluid/pressure_columns.h"

#include <utility>

namespace monarch_flight {
namespace {

/// row *= reciprocal; next += link * row: one step of elimination for m modes.
void eliminateRow(double* row, const double* reciprocal, double link, double* next, int m) {
  for (int a = 0; a < m; ++a) {
    row[a] *= reciprocal[a];
    next[a] += link * row[a];
  }
}

/// row += link * reciprocal * solved: one step of back-substitution for m modes.
void substituteRow(double* row, const double* reciprocal, double link, const double* solved,
                   int m) {
  for (int a = 0; a < m; ++a) row[a] += link * reciprocal[a] * solved[a];
}

/// All eigenvalues of an axis, class after class.
Eigen::ArrayXd allValues(const AxisModes& modes) {
  Eigen::ArrayXd values(modes.n());
  int first = 0;
  for (const ModeClass& c : modes.classes()) {
    values.segment(first, c.m()) = c.values.array();
    first += c.m();
  }
  return values;
}

}  // namespace

PressureColumns::PressureColumns(const Grid& grid, const AxisModes& x, const AxisModes& y,
                                 std::vector<SpectrumBlock> blocks)
    : nx_(x.n()), ny_(y.n()), nz_(grid.z.n()), k_wing_(grid.k_wing), blocks_(std::move(blocks)) {
  width_ = Eigen::Map<const Eigen::ArrayXd>(grid.z.width.data(), nz_);
  link_ = Eigen::Map<const Eigen::ArrayXd>(grid.z.gap.data(), nz_ + 1).inverse();
  if (!grid.open) link_[0] = link_[nz_] = 0.0;
  const Eigen::Index plane = static_cast<Eigen::Index>(nx_) * ny_;
  for (Eigen::ArrayXd* a : {&below_, &cross_, &above_, &complement_}) a->setZero(plane);
  reciprocal_.setZero(plane * nz_);
  const Eigen::ArrayXd values_x = allValues(x), values_y = allValues(y);
  for (const SpectrumBlock& q : blocks_) {
    for (int b = 0; b < q.my; ++b) {
      factor(q, b, values_x.segment(q.first_x, q.mx) + values_y[q.first_y + b]);
    }
  }
}

void PressureColumns::factor(const SpectrumBlock& q, int b, const Eigen::ArrayXd& lambda) {
  const std::ptrdiff_t at = planeIndex(q, b);
  double* slab = reciprocal_.data() + q.offset + static_cast<std::ptrdiff_t>(b) * nz_ * q.mx;
  for (int a = 0; a < q.mx; ++a) {
    double down = lambda[a] * width_[0] + link_[0];
    for (int k = 1; k < k_wing_; ++k) {
      slab[(k - 1) * q.mx + a] = 1.0 / (down + link_[k]);
      down = lambda[a] * width_[k] + link_[k] * down / (down + link_[k]);
    }
    double up = lambda[a] * width_[nz_ - 1] + link_[nz_];
    for (int k = nz_ - 2; k >= k_wing_; --k) {
      slab[(k + 1) * q.mx + a] = 1.0 / (up + link_[k + 1]);
      up = lambda[a] * width_[k] + link_[k + 1] * up / (up + link_[k + 1]);
    }
    const double l = link_[k_wing_], determinant = down * up + l * (down + up);
    if (determinant > 0.0) {
      below_[at + a] = (up + l) / determinant;
      above_[at + a] = (down + l) / determinant;
      cross_[at + a] = l / determinant;
      complement_[at + a] = down * up / determinant;
    } else {  // the constant mode with closed ends: the pseudo-inverse
      below_[at + a] = above_[at + a] = 0.25 / l;
      cross_[at + a] = -0.25 / l;
    }
  }
}

Eigen::MatrixXd PressureColumns::jumpComplement() const {
  return Eigen::Map<const Eigen::MatrixXd>(complement_.data(), nx_, ny_);
}

void PressureColumns::removeMean(double* spectrum) const {
  const int stride = blocks_[0].mx;
  double sum = 0.0;
  for (int k = 0; k < nz_; ++k) sum += spectrum[k * stride];
  const double density = sum / width_.sum();
  for (int k = 0; k < nz_; ++k) spectrum[k * stride] -= density * width_[k];
}

void PressureColumns::eliminate(double* spectrum) const {
  for (const SpectrumBlock& q : blocks_) {
    const int m = q.mx;
    for (int b = 0; b < q.my; ++b) {
      const std::ptrdiff_t at = q.offset + static_cast<std::ptrdiff_t>(b) * nz_ * m;
      double* r = spectrum + at;
      const double* reciprocal = reciprocal_.data() + at;
      for (int k = 0; k < k_wing_ - 1; ++k) {
        eliminateRow(r + k * m, reciprocal + k * m, link_[k + 1], r + (k + 1) * m, m);
      }
      for (int k = nz_ - 1; k > k_wing_; --k) {
        eliminateRow(r + k * m, reciprocal + k * m, link_[k], r + (k - 1) * m, m);
      }
    }
  }
}

void PressureColumns::jump(const double* spectrum, double* jump) const {
  for (const SpectrumBlock& q : blocks_) {
    for (int b = 0; b < q.my; ++b) {
      const std::ptrdiff_t slab = q.offset + static_cast<std::ptrdiff_t>(b) * nz_ * q.mx;
      const double* r_u = spectrum + slab + static_cast<std::ptrdiff_t>(k_wing_) * q.mx;
      const double* r_d = r_u - q.mx;
      const std::ptrdiff_t at = planeIndex(q, b);
      for (int a = 0; a < q.mx; ++a) {
        jump[at + a] =
            (below_[at + a] - cross_[at + a]) * r_d[a] - (above_[at + a] - cross_[at + a]) * r_u[a];
      }
    }
  }
}

void PressureColumns::addDipole(const double* source, double* spectrum) const {
  for (const SpectrumBlock& q : blocks_) {
    for (int b = 0; b < q.my; ++b) {
      const std::ptrdiff_t slab = q.offset + static_cast<std::ptrdiff_t>(b) * nz_ * q.mx;
      double* r_u = spectrum + slab + static_cast<std::ptrdiff_t>(k_wing_) * q.mx;
      double* r_d = r_u - q.mx;
      const std::ptrdiff_t at = planeIndex(q, b);
      for (int a = 0; a < q.mx; ++a) {
        r_d[a] += source[at + a];
        r_u[a] -= source[at + a];
      }
    }
  }
}

void PressureColumns::substitute(double* spectrum) const {
  for (const SpectrumBlock& q : blocks_) {
    const int m = q.mx;
    for (int b = 0; b < q.my; ++b) {
      const std::ptrdiff_t slab = q.offset + static_cast<std::ptrdiff_t>(b) * nz_ * m;
      double* p = spectrum + slab;
      const double* reciprocal = reciprocal_.data() + slab;
      double *up = p + k_wing_ * m, *down = up - m;
      const std::ptrdiff_t at = planeIndex(q, b);
      for (int a = 0; a < m; ++a) {
        const double r_d = down[a], r_u = up[a];
        down[a] = below_[at + a] * r_d + cross_[at + a] * r_u;
        up[a] = cross_[at + a] * r_d + above_[at + a] * r_u;
      }
      for (int k = k_wing_ - 2; k >= 0; --k) {
        substituteRow(p + k * m, reciprocal + k * m, link_[k + 1], p + (k + 1) * m, m);
      }
      for (int k = k_wing_ + 1; k < nz_; ++k) {
        substituteRow(p + k * m, reciprocal + k * m, link_[k], p + (k - 1) * m, m);
      }
    }
  }
}

void PressureColumns::centre(double* spectrum) const {
  const int stride = blocks_[0].mx;
  double sum = 0.0;
  for (int k = 0; k < nz_; ++k) sum += spectrum[k * stride] * width_[k];
  const double mean = sum / width_.sum();
  for (int k = 0; k < nz_; ++k) spectrum[k * stride] -= mean;
}

}  // namespace monarch_flight
