#include "fluid/pressure/capacitance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {

WingCapacitance::WingCapacitance(const Grid& grid, const Slab& slab, const AxisModes& x,
                                 const AxisModes& y, const WingResponse& response,
                                 const Team& team) {
  findNormalFaces(grid);
  if (normal_.empty()) return;
  if (!grid.open && static_cast<std::size_t>(wing_faces_) == grid.wing.size()) {
    throw std::invalid_argument("WingCapacitance: the wing closes the whole plane of a closed box");
  }
  findInPlaneFaces(grid);
  root_ = Eigen::Map<const Eigen::VectorXd>(list_root_.data(), list_root_.size());
  jump_.setZero(root_.size());
  flux_.setZero(root_.size());
  modes_x_ = x.rows(i0_, static_cast<int>(box_[0].rows()));
  modes_y_ = y.rows(j0_, static_cast<int>(box_[0].cols()));
  half_.resize(box_[0].rows(), y.n());
  SymmetricTiles system(static_cast<int>(root_.size()), wing_faces_);
  assembleNormal(response.complement, 1.0 / grid.z.gap[grid.k_wing], system);
  assembleInPlane(response, system);
  system.invert(team);
  inverse_ = SharedSymmetric(std::move(system), slab, grid.k_wing, team);
}

void WingCapacitance::add(double conductance, double mobility) {
  list_root_.push_back(std::sqrt(conductance));
  list_diagonal_.push_back(1 / (1 - mobility));
}

void WingCapacitance::findNormalFaces(const Grid& grid) {
  const int nx = grid.x.n(), ny = grid.y.n(), kw = grid.k_wing;
  int i1 = -1, j1 = -1;
  i0_ = nx;
  j0_ = ny;
  auto changed = [&](int i, int j) { return grid.mobility.at(2, i, j, kw) != 1; };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      if (!changed(i, j)) continue;
      i0_ = std::min(i0_, i);
      i1 = std::max(i1, i);
      j0_ = std::min(j0_, j);
      j1 = std::max(j1, j);
    }
  }
  if (i1 < 0) return;
  for (Eigen::MatrixXd& box : box_) box.setZero(i1 - i0_ + 1, j1 - j0_ + 1);
  for (bool wing : {true, false}) {
    for (int j = j0_; j <= j1; ++j) {
      for (int i = i0_; i <= i1; ++i) {
        if (!changed(i, j) || grid.isWing(i, j) != wing) continue;
        normal_.push_back(cell(i, j));
        add(grid.x.width[i] * grid.y.width[j] / grid.z.gap[kw], grid.mobility.at(2, i, j, kw));
      }
    }
    if (wing) wing_faces_ = static_cast<int>(normal_.size());
  }
}

void WingCapacitance::findInPlaneFaces(const Grid& grid) {
  const int kw = grid.k_wing;
  for (int side : {0, 1}) {
    const int k = kw - 1 + side;
    for (int j = j0_; j < j0_ + box_[0].cols(); ++j) {
      for (int i = i0_; i < i0_ + box_[0].rows(); ++i) {
        const double mx = grid.mobility.at(0, i, j, k), my = grid.mobility.at(1, i, j, k);
        if (mx != 1) {
          in_plane_.push_back({side, cell(i - 1, j), cell(i, j)});
          add(grid.y.width[j] * grid.z.width[k] / grid.x.gap[i], mx);
        }
        if (my != 1) {
          in_plane_.push_back({side, cell(i, j - 1), cell(i, j)});
          add(grid.x.width[i] * grid.z.width[k] / grid.y.gap[j], my);
        }
      }
    }
  }
}

/// Row by row of the plane: S(rows j, j') = X_j diag(G(:, j')) X_j'^T with
/// G(a, j') = sum_b phi_b(j) phi_b(j') complement(a, b), which is 1 - l g without cancellation, for
/// sum_ab phi_ab(f) phi_ab(g) = delta_fg / area. No three-dimensional solve is needed.
void WingCapacitance::assembleNormal(const Eigen::MatrixXd& complement, double link,
                                     SymmetricTiles& system) const {
  const int nbx = static_cast<int>(box_[0].rows()), rows = static_cast<int>(box_[0].cols());
  std::vector<int> first(2 * rows + 1, 0);  // rows of the wing's faces, then of those beside it
  for (std::size_t f = 0; f < normal_.size(); ++f)
    ++first[normal_[f] / nbx + (static_cast<int>(f) < wing_faces_ ? 0 : rows) + 1];
  for (int r = 0; r < 2 * rows; ++r) first[r + 1] += first[r];
  std::vector<Eigen::MatrixXd> x_rows(2 * rows);  // modes (rows) by the faces of a row
  for (int r = 0; r < 2 * rows; ++r) {
    x_rows[r].resize(modes_x_.cols(), first[r + 1] - first[r]);
    for (int f = first[r]; f < first[r + 1]; ++f) {
      x_rows[r].col(f - first[r]) =
          root_[f] / std::sqrt(link) * modes_x_.row(normal_[f] % nbx).transpose();
    }
  }
  Eigen::MatrixXd block;
  for (int r = 0; r < 2 * rows; ++r) {
    if (first[r] == first[r + 1]) continue;
    const Eigen::MatrixXd g =
        complement * modes_y_.row(r % rows).asDiagonal() * modes_y_.transpose();
    for (int other = 0; other <= r; ++other) {
      block.noalias() = x_rows[r].transpose() * (g.col(other % rows).asDiagonal() * x_rows[other]);
      for (int c = first[other]; c < first[other + 1]; ++c) {
        double* column = system.column(c);
        for (int f = std::max(first[r], c); f < first[r + 1]; ++f)
          column[f] = block(f - first[r], c - first[other]);
      }
    }
  }
  for (int f = 0; f < first[2 * rows]; ++f) system.column(f)[f] += list_diagonal_[f] - 1;
}

/// Column by column: the jumps that answer a unit source of each face.
void WingCapacitance::assembleInPlane(const WingResponse& response, SymmetricTiles& system) const {
  const int n = static_cast<int>(normal_.size()), nbx = static_cast<int>(box_[0].rows());
  Eigen::MatrixXd source, answer;
  for (std::size_t e = 0; e < in_plane_.size(); ++e) {
    const Link& link = in_plane_[e];
    auto mode = [&](int q) { return modes_x_.row(q % nbx).transpose() * modes_y_.row(q / nbx); };
    source = mode(link.first);
    source -= mode(link.second);
    for (int side : {0, 1}) {
      const Eigen::MatrixXd& own = link.side == 0 ? response.below : response.above;
      answer = source.cwiseProduct(side == link.side ? own : response.cross);
      toBox(answer.data(), box_[side]);
    }
    takeJumps();
    const int face = n + static_cast<int>(e);
    for (int c = 0; c <= face; ++c) system.column(c)[face] = -root_[face] * jump_[c];
    system.column(face)[face] += list_diagonal_[face];
  }
}

void WingCapacitance::toBox(const double* modes, Eigen::MatrixXd& box) const {
  const int nx = static_cast<int>(modes_x_.cols()), ny = static_cast<int>(modes_y_.cols());
  const int bx = static_cast<int>(box.rows()), by = static_cast<int>(box.cols());
  product(CblasNoTrans, CblasNoTrans, bx, ny, nx, 1.0, modes_x_.data(), bx, modes, nx, half_.data(),
          bx);
  product(CblasNoTrans, CblasTrans, bx, by, ny, 1.0, half_.data(), bx, modes_y_.data(), by,
          box.data(), bx);
}

void WingCapacitance::toModes(const Eigen::MatrixXd& box, double* modes) const {
  const int nx = static_cast<int>(modes_x_.cols()), ny = static_cast<int>(modes_y_.cols());
  const int bx = static_cast<int>(box.rows()), by = static_cast<int>(box.cols());
  product(CblasNoTrans, CblasNoTrans, bx, ny, by, 1.0, box.data(), bx, modes_y_.data(), by,
          half_.data(), bx);
  product(CblasTrans, CblasNoTrans, nx, ny, bx, 1.0, modes_x_.data(), bx, half_.data(), bx, modes,
          nx);
}

/// sqrt(c) times the jump of the pressures in the box, of every face.
void WingCapacitance::takeJumps() const {
  const double* down = box_[0].data();
  const double* up = box_[1].data();
  const std::size_t n = normal_.size();
  for (std::size_t f = 0; f < n; ++f) jump_[f] = root_[f] * (down[normal_[f]] - up[normal_[f]]);
  for (std::size_t e = 0; e < in_plane_.size(); ++e) {
    const double* p = in_plane_[e].side == 0 ? down : up;
    jump_[n + e] = root_[n + e] * (p[in_plane_[e].first] - p[in_plane_[e].second]);
  }
}

void WingCapacitance::answer(double* down, double* up) const {
  toBox(down, box_[0]);
  toBox(up, box_[1]);
  takeJumps();
  inverse_.multiply(jump_.data(), flux_.data());
  for (Eigen::MatrixXd& box : box_) box.setZero();
  const std::size_t n = normal_.size();
  for (std::size_t f = 0; f < n; ++f) {
    const double source = root_[f] * flux_[f];
    box_[0].data()[normal_[f]] += source;
    box_[1].data()[normal_[f]] -= source;
  }
  for (std::size_t e = 0; e < in_plane_.size(); ++e) {
    const double source = root_[n + e] * flux_[n + e];
    double* s = box_[in_plane_[e].side].data();
    s[in_plane_[e].first] += source;
    s[in_plane_[e].second] -= source;
  }
  toModes(box_[0], down);
  toModes(box_[1], up);
}

}  // namespace monarch_flight::fluid::pressure
