#include "fluid/pressure_capacitance.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fluid/blas.h"

namespace monarch_flight {

WingCapacitance::WingCapacitance(const Grid& grid, const AxisModes& x, const AxisModes& y,
                                 const Eigen::MatrixXd& complement)
    : link_(1.0 / grid.z.gap[grid.k_wing]) {
  findFaces(grid);
  if (faces() == 0) return;
  if (!grid.open && static_cast<std::size_t>(faces()) == grid.wing.size()) {
    throw std::invalid_argument("WingCapacitance: the wing closes the whole plane of a closed box");
  }
  modes_x_ = x.rows(i0_, static_cast<int>(box_.rows()));
  modes_y_ = y.rows(j0_, static_cast<int>(box_.cols()));
  half_.resize(box_.rows(), y.n());
  assemble(complement);
  invert();
}

void WingCapacitance::findFaces(const Grid& grid) {
  const int nx = grid.x.n(), ny = grid.y.n();
  int i1 = -1, j1 = -1;
  i0_ = nx;
  j0_ = ny;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      if (!grid.isWing(i, j)) continue;
      i0_ = std::min(i0_, i);
      i1 = std::max(i1, i);
      j0_ = std::min(j0_, j);
      j1 = std::max(j1, j);
    }
  }
  if (i1 < 0) return;
  box_.setZero(i1 - i0_ + 1, j1 - j0_ + 1);
  std::vector<double> root;
  for (int j = j0_; j <= j1; ++j) {
    for (int i = i0_; i <= i1; ++i) {
      if (!grid.isWing(i, j)) continue;
      face_.push_back((j - j0_) * static_cast<int>(box_.rows()) + i - i0_);
      root.push_back(std::sqrt(grid.x.width[i] * grid.y.width[j]));
    }
  }
  root_area_ = Eigen::Map<const Eigen::VectorXd>(root.data(), root.size());
  jump_.setZero(faces());
  flux_.setZero(faces());
}

/// Row by row of the wing: S(rows j, j') = X_j diag(G(:, j')) X_j'^T with
/// G(a, j') = sum_b phi_b(j) phi_b(j') complement(a, b). No three-dimensional solve is needed.
void WingCapacitance::assemble(const Eigen::MatrixXd& complement) {
  const int rows = static_cast<int>(box_.cols()), nbx = static_cast<int>(box_.rows());
  std::vector<int> first(rows + 1, 0);
  for (int face : face_) ++first[face / nbx + 1];
  for (int j = 0; j < rows; ++j) first[j + 1] += first[j];
  std::vector<Eigen::MatrixXd> x_rows(rows);  // modes (rows) by the wing's cells of row j
  for (int j = 0; j < rows; ++j) {
    x_rows[j].resize(modes_x_.cols(), first[j + 1] - first[j]);
    for (int f = first[j]; f < first[j + 1]; ++f) {
      x_rows[j].col(f - first[j]) = root_area_[f] * modes_x_.row(face_[f] % nbx).transpose();
    }
  }
  inverse_.setZero(faces(), faces());
  for (int j = 0; j < rows; ++j) {
    const Eigen::MatrixXd g = complement * modes_y_.row(j).asDiagonal() * modes_y_.transpose();
    for (int other = 0; other <= j; ++other) {
      inverse_.block(first[j], first[other], x_rows[j].cols(), x_rows[other].cols()).noalias() =
          x_rows[j].transpose() * (g.col(other).asDiagonal() * x_rows[other]);
    }
  }
}

void WingCapacitance::invert() {
  const int n = faces();
  int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, inverse_.data(), n);
  if (info == 0) info = LAPACKE_dpotri(LAPACK_COL_MAJOR, 'L', n, inverse_.data(), n);
  if (info != 0) {
    throw std::runtime_error("WingCapacitance: Cholesky failed at face " + std::to_string(info) +
                             " of " + std::to_string(n));
  }
}

void WingCapacitance::answer(double* modes) const {
  const int nx = static_cast<int>(modes_x_.cols()), ny = static_cast<int>(modes_y_.cols());
  const int bx = static_cast<int>(box_.rows()), by = static_cast<int>(box_.cols()), n = faces();
  product(CblasNoTrans, CblasNoTrans, bx, ny, nx, 1.0, modes_x_.data(), bx, modes, nx, half_.data(),
          bx);
  product(CblasNoTrans, CblasTrans, bx, by, ny, 1.0, half_.data(), bx, modes_y_.data(), by,
          box_.data(), bx);
  for (int f = 0; f < n; ++f) jump_[f] = root_area_[f] * box_.data()[face_[f]];
  cblas_dsymv(CblasColMajor, CblasLower, n, link_, inverse_.data(), n, jump_.data(), 1, 0.0,
              flux_.data(), 1);
  box_.setZero();
  for (int f = 0; f < n; ++f) box_.data()[face_[f]] = root_area_[f] * flux_[f];
  product(CblasNoTrans, CblasNoTrans, bx, ny, by, 1.0, box_.data(), bx, modes_y_.data(), by,
          half_.data(), bx);
  product(CblasTrans, CblasNoTrans, nx, ny, bx, 1.0, modes_x_.data(), bx, half_.data(), bx, modes,
          nx);
}

}  // namespace monarch_flight
