#pragma once
#include <string>
#include <vector>

namespace monarch_flight::verify {

/// Two columns of a file in bench/verify/data, in rising order of the first; '#' begins a comment.
struct Table {
  std::vector<double> x, y;

  /// Linear between its points, NaN outside them.
  double at(double x) const;
};

/// Throws InputError when the file cannot be read.
Table readTable(const std::string& file);

}  // namespace monarch_flight::verify
