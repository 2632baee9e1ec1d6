#include "fluid/pressure/columns.h"

#include <algorithm>
#include <utility>

namespace monarch_flight::fluid::pressure {
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

PressureColumns::PressureColumns(const Grid& grid, const Slab& slab, const AxisModes& x,
                                 const AxisModes& y, std::vector<SpectrumBlock> blocks,
                                 const Team& team)
    : slab_(slab),
      team_(team),
      nx_(x.n()),
      ny_(y.n()),
      nz_(grid.z.n()),
      k_wing_(grid.k_wing),
      blocks_(std::move(blocks)) {
  width_ = Eigen::Map<const Eigen::ArrayXd>(grid.z.width.data(), nz_);
  link_ = Eigen::Map<const Eigen::ArrayXd>(grid.z.gap.data(), nz_ + 1).inverse();
  if (!grid.open) link_[0] = link_[nz_] = 0.0;
  const Eigen::Index plane = static_cast<Eigen::Index>(nx_) * ny_;
  for (Eigen::ArrayXd* a : {&below_, &cross_, &above_, &complement_, &r_d_, &r_u_, &passing_})
    a->setZero(plane);
  reciprocal_.setZero(plane * slab_.planes());
  const Eigen::ArrayXd values_x = allValues(x), values_y = allValues(y);
  for (const SpectrumBlock& q : blocks_) {
    for (int b = 0; b < q.my; ++b) {
      rows_.push_back({static_cast<int>(&q - blocks_.data()), b});
      factor(q, b, values_x.segment(q.first_x, q.mx) + values_y[q.first_y + b]);
    }
  }
}

void PressureColumns::factor(const SpectrumBlock& q, int b, const Eigen::ArrayXd& lambda) {
  const std::ptrdiff_t at = planeIndex(q, b);
  auto keep = [&](int k, int a, double reciprocal) {
    if (slab_.owns(k)) reciprocal_[row(q, b, k) + a] = reciprocal;
  };
  for (int a = 0; a < q.mx; ++a) {
    double down = lambda[a] * width_[0] + link_[0];
    for (int k = 1; k < k_wing_; ++k) {
      keep(k - 1, a, 1.0 / (down + link_[k]));
      down = lambda[a] * width_[k] + link_[k] * down / (down + link_[k]);
    }
    double up = lambda[a] * width_[nz_ - 1] + link_[nz_];
    for (int k = nz_ - 2; k >= k_wing_; --k) {
      keep(k + 1, a, 1.0 / (up + link_[k + 1]));
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

WingResponse PressureColumns::wingResponse() const {
  auto modes = [&](const Eigen::ArrayXd& a) {
    return Eigen::Map<const Eigen::MatrixXd>(a.data(), nx_, ny_);
  };
  return {modes(below_), modes(cross_), modes(above_), modes(complement_)};
}

void PressureColumns::removeMean(double* spectrum) const {
  double* mode = spectrum + row(blocks_[0], 0, slab_.k0());
  const int stride = blocks_[0].mx;
  double sum = 0.0;
  for (int k = 0; k < slab_.planes(); ++k) sum += mode[k * stride];
  slab_.sum(&sum, 1);
  const double density = sum / width_.sum();
  for (int k = 0; k < slab_.planes(); ++k) mode[k * stride] -= density * width_[slab_.k0() + k];
}

void PressureColumns::takePlane(const double* spectrum, int k, double* plane) const {
  eachRow([&](const SpectrumBlock& q, int b) {
    std::copy_n(spectrum + row(q, b, k), q.mx, plane + planeIndex(q, b));
  });
}

/// Half 0: the planes below the wing, upwards; half 1: those above, downwards. What a process
/// passes on is its last row, to be added to the next process's first one with the link between
/// them.
void PressureColumns::eliminateHalf(double* spectrum, int half) const {
  const int towards = half == 0 ? 1 : -1;
  const int first = half == 0 ? slab_.k0() : slab_.k1() - 1;
  const int last = half == 0 ? std::min(slab_.k1(), k_wing_) - 1 : std::max(slab_.k0(), k_wing_);
  if ((last - first) * towards < 0) return;  // no plane of this half here
  const int plane = nx_ * ny_;
  const bool continues = half == 0 ? !slab_.atBottom() : !slab_.atTop();
  const bool passes_on = last != (half == 0 ? k_wing_ - 1 : k_wing_);
  if (continues) {
    half == 0 ? slab_.receiveFromBelow(passing_.data(), plane)
              : slab_.receiveFromAbove(passing_.data(), plane);
  }
  eachRow([&](const SpectrumBlock& q, int b) {
    double* r = spectrum + row(q, b, first);
    const double* reciprocal = reciprocal_.data() + row(q, b, first);
    double* passing = passing_.data() + planeIndex(q, b);
    if (continues) {
      for (int a = 0; a < q.mx; ++a) r[a] += passing[a];
    }
    for (int k = first; k != last;
         k += towards, r += towards * q.mx, reciprocal += towards * q.mx) {
      eliminateRow(r, reciprocal, link_[half == 0 ? k + 1 : k], r + towards * q.mx, q.mx);
    }
    if (passes_on) {
      std::fill_n(passing, q.mx, 0.0);
      eliminateRow(r, reciprocal, link_[half == 0 ? last + 1 : last], passing, q.mx);
    }
  });
  if (passes_on) {
    half == 0 ? slab_.sendUp(passing_.data(), plane) : slab_.sendDown(passing_.data(), plane);
  }
}

void PressureColumns::eliminate(double* spectrum) const {
  eliminateHalf(spectrum, 0);
  eliminateHalf(spectrum, 1);
}

void PressureColumns::meet(const double* spectrum) const {
  if (!touchesWing()) return;
  const int plane = nx_ * ny_;
  if (slab_.owns(k_wing_ - 1)) takePlane(spectrum, k_wing_ - 1, r_d_.data());
  if (slab_.owns(k_wing_)) takePlane(spectrum, k_wing_, r_u_.data());
  if (slab_.k1() == k_wing_) slab_.exchangeAbove(r_d_.data(), r_u_.data(), plane);
  if (slab_.k0() == k_wing_) slab_.exchangeBelow(r_u_.data(), r_d_.data(), plane);
}

void PressureColumns::wingPressures(double* down, double* up) const {
  Eigen::Map<Eigen::ArrayXd>(down, r_d_.size()) = below_ * r_d_ + cross_ * r_u_;
  Eigen::Map<Eigen::ArrayXd>(up, r_d_.size()) = cross_ * r_d_ + above_ * r_u_;
}

void PressureColumns::addSources(const double* down, const double* up) const {
  r_d_ += Eigen::Map<const Eigen::ArrayXd>(down, r_d_.size());
  r_u_ += Eigen::Map<const Eigen::ArrayXd>(up, r_d_.size());
}

void PressureColumns::solveAtWing(double* spectrum) const {
  eachRow([&](const SpectrumBlock& q, int b) {
    const std::ptrdiff_t at = planeIndex(q, b);
    if (slab_.owns(k_wing_ - 1)) {
      double* p = spectrum + row(q, b, k_wing_ - 1);
      for (int a = 0; a < q.mx; ++a)
        p[a] = below_[at + a] * r_d_[at + a] + cross_[at + a] * r_u_[at + a];
    }
    if (slab_.owns(k_wing_)) {
      double* p = spectrum + row(q, b, k_wing_);
      for (int a = 0; a < q.mx; ++a)
        p[a] = cross_[at + a] * r_d_[at + a] + above_[at + a] * r_u_[at + a];
    }
  });
}

void PressureColumns::substituteHalf(double* spectrum, int half) const {
  const int outwards = half == 0 ? -1 : 1;
  const int last = half == 0 ? slab_.k0() : slab_.k1() - 1;
  const int nearest = half == 0 ? std::min(slab_.k1(), k_wing_) - 1 : std::max(slab_.k0(), k_wing_);
  if ((last - nearest) * outwards < 0) return;
  const int plane = nx_ * ny_;
  const bool at_wing = nearest == (half == 0 ? k_wing_ - 1 : k_wing_);
  if (!at_wing) {
    half == 0 ? slab_.receiveFromAbove(passing_.data(), plane)
              : slab_.receiveFromBelow(passing_.data(), plane);
  }
  eachRow([&](const SpectrumBlock& q, int b) {
    double* p = spectrum + row(q, b, nearest);
    const double* reciprocal = reciprocal_.data() + row(q, b, nearest);
    auto link = [&](int k) { return link_[half == 0 ? k + 1 : k]; };
    if (!at_wing) {
      substituteRow(p, reciprocal, link(nearest), passing_.data() + planeIndex(q, b), q.mx);
    }
    for (int k = nearest; k != last; k += outwards) {
      p += outwards * q.mx;
      reciprocal += outwards * q.mx;
      substituteRow(p, reciprocal, link(k + outwards), p - outwards * q.mx, q.mx);
    }
  });
  const bool passes_on = half == 0 ? !slab_.atBottom() : !slab_.atTop();
  if (!passes_on) return;
  takePlane(spectrum, last, passing_.data());
  half == 0 ? slab_.sendDown(passing_.data(), plane) : slab_.sendUp(passing_.data(), plane);
}

void PressureColumns::substitute(double* spectrum) const {
  substituteHalf(spectrum, 0);
  substituteHalf(spectrum, 1);
}

void PressureColumns::centre(double* spectrum) const {
  double* mode = spectrum + row(blocks_[0], 0, slab_.k0());
  const int stride = blocks_[0].mx;
  double sum = 0.0;
  for (int k = 0; k < slab_.planes(); ++k) sum += mode[k * stride] * width_[slab_.k0() + k];
  slab_.sum(&sum, 1);
  const double mean = sum / width_.sum();
  for (int k = 0; k < slab_.planes(); ++k) mode[k * stride] -= mean;
}

}  // namespace monarch_flight::fluid::pressure
