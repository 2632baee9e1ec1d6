#pragma once
#include <istream>
#include <string>
#include <vector>

namespace monarch_flight {

/// Named columns of numbers, as read from a CSV file or from a case file.
struct NumericTable {
  std::string name;                       ///< what messages call it: the file's path
  std::vector<std::string> columns;       ///< header names
  std::vector<std::vector<double>> rows;  ///< every row as long as `columns`

  /// Index of a column, or -1.
  int find(const std::string& column) const;
  /// All values of an existing column.
  std::vector<double> column(const std::string& column) const;
  /// The table with just these columns, in this order; InputError naming every missing one.
  NumericTable select(const std::vector<std::string>& wanted) const;
};

/// Reads a CSV file: one header line of names, then rows of numbers; blank lines and lines that
/// begin with '#' are skipped. Throws InputError naming file, row (1 is the first row of numbers),
/// line and column of every cell that is not a finite number, up to ten, and of every row of the
/// wrong length; columns that are separated by semicolons, tabs or blanks are named as such.
NumericTable readCsv(std::istream& in, const std::string& name);
NumericTable readCsv(const std::string& path);

}  // namespace monarch_flight
