#pragma once
#include <vector>

#include "fluid/fields/field.h"
#include "fluid/fields/team.h"

namespace monarch_flight::fluid::pressure {

/// A symmetric matrix as the tiles of its lower triangle. A panel is a column of tiles, stored in
/// one piece, column major. All panels have about the same number of entries, but that one of them
/// ends where the negative definite part begins. Takes 0.6 of the memory of the whole square.
class SymmetricTiles {
 public:
  SymmetricTiles() = default;
  /// Zero. What `invert` is to invert is quasi-definite: the first `positive` rows and columns by
  /// themselves are positive definite, the others by themselves negative definite.
  SymmetricTiles(int rows, int positive);

  int rows() const { return first_.empty() ? 0 : first_.back(); }
  int panels() const { return static_cast<int>(panels_.size()); }
  int first(int tile) const { return first_[tile]; }  ///< its first row or column; tile < panels()
  int width(int tile) const { return first_[tile + 1] - first_[tile]; }
  int leading(int panel) const { return rows() - first_[panel]; }  ///< dimension: its rows
  /// Row and column of tiles, row >= column.
  double* tile(int row, int column) {
    return panels_[column].data() + first_[row] - first_[column];
  }
  const double* tile(int row, int column) const {
    return panels_[column].data() + first_[row] - first_[column];
  }
  /// Entries (r, c) of one column by their row, r >= c.
  double* column(int c);

  /// In place, by S = L J L^T, J the signs: S^-1 = W^T J W, W = L^-1. The same bits for any team.
  /// Throws std::runtime_error where S is not quasi-definite or not finite.
  void invert(const Team& team);
  /// Gives back the memory of the panels outside of [begin, end).
  void keep(int begin, int end);

 private:
  double sign(int tile) const { return first_[tile] < positive_ ? 1.0 : -1.0; }
  void factorise(const Team& team);
  void invertFactor(const Team& team);
  void squareFactor(const Team& team);
  /// Tile (row, column) += W_k,row^T J W_k,column of all k below the row.
  void addBelow(int row, int column);

  std::vector<int> first_;  ///< of the tiles; then the number of rows
  int positive_ = 0;
  std::vector<Array> panels_;
};

}  // namespace monarch_flight::fluid::pressure
