#include "verify/table.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "monarch_flight/math/errors.h"

namespace monarch_flight::verify {

double Table::at(double position) const {
  const auto above = std::lower_bound(x.begin(), x.end(), position);
  if (above == x.end() || (above == x.begin() && *above > position))
    return std::numeric_limits<double>::quiet_NaN();
  const std::size_t i = above - x.begin();
  if (i == 0) return y[0];
  return y[i - 1] + (y[i] - y[i - 1]) * (position - x[i - 1]) / (x[i] - x[i - 1]);
}

Table readTable(const std::string& file) {
  const std::string path = VERIFY_DATA_DIR "/" + file;
  std::ifstream in(path);
  if (!in) throw InputError("cannot read " + path);
  std::vector<std::pair<double, double>> rows;
  for (std::string line; std::getline(in, line);) {
    double x, y;
    if (line[0] != '#' && std::istringstream(line) >> x >> y) rows.emplace_back(x, y);
  }
  std::sort(rows.begin(), rows.end());
  Table table;
  for (const auto& [x, y] : rows) {
    table.x.push_back(x);
    table.y.push_back(y);
  }
  return table;
}

}  // namespace monarch_flight::verify
