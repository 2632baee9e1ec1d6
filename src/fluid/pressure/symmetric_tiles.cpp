#include "fluid/pressure/symmetric_tiles.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fluid/pressure/blas.h"

namespace monarch_flight::fluid::pressure {
namespace {

constexpr int kPanels = 8;  // work for threads; the same for any number of them

}  // namespace

SymmetricTiles::SymmetricTiles(int rows, int positive) : positive_(positive) {
  first_ = {0, positive, rows};
  for (int column = 1; column < kPanels; ++column)  // of the triangle, all alike
    first_.push_back(rows - static_cast<int>(rows * std::sqrt(1 - column / double(kPanels))));
  std::sort(first_.begin(), first_.end());
  first_.erase(std::unique(first_.begin(), first_.end()), first_.end());
  for (std::size_t t = 0; t + 1 < first_.size(); ++t)
    panels_.emplace_back(static_cast<std::size_t>(rows - first_[t]) * (first_[t + 1] - first_[t]));
}

double* SymmetricTiles::column(int c) {
  const auto after = std::upper_bound(first_.begin(), first_.end(), c);
  const int t = static_cast<int>(after - first_.begin()) - 1;
  return panels_[t].data() + static_cast<std::ptrdiff_t>(c - first_[t]) * leading(t) - first_[t];
}

void SymmetricTiles::keep(int begin, int end) {
  for (int t = 0; t < panels(); ++t) {
    if (t < begin || t >= end) Array().swap(panels_[t]);
  }
}

void SymmetricTiles::invert(const Team& team) {
  factorise(team);
  invertFactor(team);
  squareFactor(team);
}

void SymmetricTiles::factorise(const Team& team) {
  for (int k = 0; k < panels(); ++k) {
    if (sign(k) < 0) {
      for (double& entry : panels_[k]) entry = -entry;
    }
    const int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', width(k), tile(k, k), leading(k));
    if (info < 0) throw std::runtime_error("SymmetricTiles: an entry is not finite");
    if (info > 0) {
      throw std::runtime_error("SymmetricTiles: not quasi-definite at row " +
                               std::to_string(first_[k] + info) + " of " + std::to_string(rows()));
    }
    team.each(k + 1, panels(), [&](int i, int) {
      cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, width(i),
                  width(k), 1.0, tile(k, k), leading(k), tile(i, k), leading(k));
    });
    team.each(k + 1, panels(), [&](int j, int) {
      cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, width(j), width(k), -sign(k), tile(j, k),
                  leading(k), 1.0, tile(j, j), leading(j));
      if (j + 1 == panels()) return;
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, leading(j + 1), width(j), width(k),
                  -sign(k), tile(j + 1, k), leading(k), tile(j, k), leading(k), 1.0, tile(j + 1, j),
                  leading(j));
    });
  }
}

/// Column after column of tiles: W_ij = -W_ii (L_ij W_jj + sum of L_ik W_kj, j < k < i).
void SymmetricTiles::invertFactor(const Team& team) {
  for (int j = 0; j < panels(); ++j) {
    team.each(j + 1, panels(), [&](int i, int) {
      cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, width(i),
                  width(j), 1.0, tile(j, j), leading(j), tile(i, j), leading(j));
    });
    for (int k = j + 1; k < panels(); ++k) {
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, width(k),
                  width(j), -1.0, tile(k, k), leading(k), tile(k, j), leading(j));
      team.each(k + 1, panels(), [&](int i, int) {
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, width(i), width(j), width(k), 1.0,
                    tile(i, k), leading(k), tile(k, j), leading(j), 1.0, tile(i, j), leading(j));
      });
    }
    LAPACKE_dtrtri(LAPACK_COL_MAJOR, 'L', 'N', width(j), tile(j, j), leading(j));
  }
}

void SymmetricTiles::addBelow(int row, int column) {
  const int begin = first_[row + 1], border = std::clamp(positive_, begin, rows());
  const int ends[] = {begin, border, rows()};
  for (int part : {0, 1}) {
    const int from = ends[part], count = ends[part + 1] - from;
    if (count == 0) continue;
    const double by = part == 0 ? 1.0 : -1.0;
    const double* a = panels_[row].data() + from - first_[row];
    const double* b = panels_[column].data() + from - first_[column];
    if (row == column) {
      cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, width(row), count, by, a, leading(row),
                  1.0, tile(row, row), leading(row));
    } else {
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, width(row), width(column), count, by, a,
                  leading(row), b, leading(column), 1.0, tile(row, column), leading(column));
    }
  }
}

/// Row after row of tiles, the one on the diagonal last: the others of its row need it.
void SymmetricTiles::squareFactor(const Team& team) {
  for (int i = 0; i < panels(); ++i) {
    team.each(0, i, [&](int j, int) {
      cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, width(i),
                  width(j), sign(i), tile(i, i), leading(i), tile(i, j), leading(j));
      addBelow(i, j);
    });
    LAPACKE_dlauum(LAPACK_COL_MAJOR, 'L', width(i), tile(i, i), leading(i));
    if (sign(i) < 0) {
      for (int c = 0; c < width(i); ++c)
        cblas_dscal(width(i) - c, -1.0,
                    &tile(i, i)[c + static_cast<std::ptrdiff_t>(c) * leading(i)], 1);
    }
    addBelow(i, i);
  }
}

}  // namespace monarch_flight::fluid::pressure
