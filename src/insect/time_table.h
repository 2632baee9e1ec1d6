#pragma once
#include <string>
#include <vector>

#include "monarch_flight/insect/numeric_table.h"

namespace monarch_flight {

constexpr std::size_t kMostTableFaults = 10;

/// "<table>: row 7, column phi", the first row being row 1.
std::string tablePlace(const NumericTable& table, std::size_t row, const std::string& column);

/// Faults of a table whose first column is the time t [s], each naming row and column, up to ten:
/// fewer than `least` rows, a value that is not finite, time that does not increase, a gap (a
/// spacing above 1.5 times the median).
std::vector<std::string> timeTableFaults(const NumericTable& table, std::size_t least);

}  // namespace monarch_flight
