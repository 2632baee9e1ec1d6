#include "insect/time_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace monarch_flight {
namespace {

constexpr double kGapFactor = 1.5;

void checkFinite(const NumericTable& table, std::vector<std::string>& faults) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (std::size_t k = 0; k < table.columns.size() && faults.size() < kMostTableFaults; ++k) {
      if (std::isfinite(table.rows[i][k])) continue;
      faults.push_back(tablePlace(table, i, table.columns[k]) +
                       " is not a finite number; correct it");
    }
  }
}

void checkTimes(const NumericTable& table, std::vector<std::string>& faults) {
  std::vector<double> spacing;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    spacing.push_back(table.rows[i][0] - table.rows[i - 1][0]);
  }
  std::vector<double> sorted = spacing;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < spacing.size() && faults.size() < kMostTableFaults; ++i) {
    std::ostringstream text;
    text.precision(9);
    text << tablePlace(table, i + 1, "t") << " = " << table.rows[i + 1][0] << " s: ";
    if (!(spacing[i] > 0.0)) {
      text << "must be > " << table.rows[i][0] << " s of the row before; time must not go back";
      faults.push_back(text.str());
    } else if (median > 0.0 && spacing[i] > kGapFactor * median) {
      text << "gap of " << spacing[i] << " s: must be <= " << kGapFactor
           << " times the usual spacing of " << median << " s; fill in the missing rows";
      faults.push_back(text.str());
    }
  }
}

}  // namespace

std::string tablePlace(const NumericTable& table, std::size_t row, const std::string& column) {
  return table.name + ": row " + std::to_string(row + 1) + ", column " + column;
}

std::vector<std::string> timeTableFaults(const NumericTable& table, std::size_t least) {
  const std::size_t n = table.rows.size();
  if (n < least) {
    return {table.name + ": " + std::to_string(n) + " rows: must be >= " + std::to_string(least) +
            "; give more rows"};
  }
  std::vector<std::string> faults;
  checkFinite(table, faults);
  if (faults.empty()) checkTimes(table, faults);
  return faults;
}

}  // namespace monarch_flight
