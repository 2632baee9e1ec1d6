// Is what a table tells from row to row a motion? The mean speed between two rows must lie between
// those before and behind it and the one to which a smooth curve through two speeds on each side
// leads, give or take half of the largest of these: what one row alone tells is a jump, and what
// alternates is too fast for the rows. The rule knows no time and no size of the motion; a sine
// passes it with six rows in its period, at which the spline misses its acceleration by 0.2 %.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "insect/table_checks.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

constexpr double kGive = 0.5;       // of the largest speed around
constexpr double kRounding = 0.01;  // rad, or of the length: smaller changes may be what they like

/// Columns that are the components of one vector.
struct Group {
  Eigen::Index first, count;
  const char *unit, *change;
};

const std::vector<Group>& groupsOf(TableKind kind) {
  static const std::vector<Group> wing{{0, 3, "m", "changes"}, {3, 3, "rad", "turns"}};
  static const std::vector<Group> body{{0, 3, "m", "changes"},   {3, 1, "rad", "changes"},
                                       {4, 1, "rad", "changes"}, {5, 1, "rad", "changes"},
                                       {6, 1, "rad", "changes"}, {7, 1, "rad", "changes"}};
  return kind == TableKind::kWing ? wing : body;
}

Eigen::Quaterniond attitude(const std::vector<double>& row) {
  return {row[4], row[5], row[6], row[7]};
}

/// Mean speeds between the rows: a column for each interval; turns in the axes of the wing.
Eigen::MatrixXd speedsOf(const NumericTable& table, TableKind kind) {
  const std::size_t n = table.rows.size() - 1;
  Eigen::MatrixXd speeds(kind == TableKind::kWing ? 6 : 8, n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double>&a = table.rows[i], &b = table.rows[i + 1];
    const double spacing = b[0] - a[0];
    for (Eigen::Index k = 0; k < (kind == TableKind::kWing ? 3 : 8); ++k) {
      speeds(k, i) = (b[k + 1] - a[k + 1]) / spacing;
    }
    if (kind == TableKind::kWing) {
      const Eigen::Quaterniond turn = attitude(a).conjugate() * attitude(b);
      speeds.col(i).tail<3>() = logSO3(turn.toRotationMatrix()) / spacing;
    }
  }
  return speeds;
}

/// The rule, for the intervals of one table.
class Speeds {
 public:
  Speeds(const NumericTable& table, TableKind kind) : speeds_(speedsOf(table, kind)) {
    for (std::size_t i = 1; i < table.rows.size(); ++i) {
      middle_.push_back(0.5 * (table.rows[i - 1][0] + table.rows[i][0]));
    }
  }

  struct Expected {
    double least, largest;  // of one component
  };
  double at(Eigen::Index component, int i) const { return speeds_(component, i); }

  /// What the speeds around interval i lead to.
  Expected expected(Eigen::Index component, int i) const {
    const int last = static_cast<int>(middle_.size()) - 1;
    std::array<double, 3> all{};
    if (i == 0 || i == last) {  // one side: nearest, along a line, along a parabola
      const int s = i == 0 ? 1 : -1;
      all = {speeds_(component, i + s), curve(component, i, {i + s, i + 2 * s}),
             curve(component, i, {i + s, i + 2 * s, i + 3 * s})};
    } else {
      std::vector<int> around{i - 1, i + 1};
      if (i > 1) around.push_back(i - 2);
      if (i + 1 < last) around.push_back(i + 2);
      all = {speeds_(component, i - 1), speeds_(component, i + 1), curve(component, i, around)};
    }
    return {*std::min_element(all.begin(), all.end()), *std::max_element(all.begin(), all.end())};
  }

 private:
  /// Value at interval i of the polynomial through the speeds of others.
  double curve(Eigen::Index component, int i, const std::vector<int>& others) const {
    double sum = 0.0;
    for (const int j : others) {
      double weight = 1.0;
      for (const int k : others) {
        if (k != j) weight *= (middle_[i] - middle_[k]) / (middle_[j] - middle_[k]);
      }
      sum += weight * speeds_(component, j);
    }
    return sum;
  }

  Eigen::MatrixXd speeds_;
  std::vector<double> middle_;  // of the intervals [s]
};

std::string text(const NumericTable& table, TableKind kind, const Group& group, int i,
                 Eigen::Index component, double change, double bound) {
  const bool turn = kind == TableKind::kWing && group.first == 3;
  const std::string column = turn ? "qw..qz" : table.columns[component + 1];
  std::ostringstream out;
  out.precision(4);
  out << tablePlace(table, i + 1, column);
  if (!turn) out << " = " << table.rows[i + 1][component + 1] << ' ' << group.unit;
  out << ": " << group.change << " by " << change << ' ' << group.unit;
  if (turn)
    out << " about the wing's "
        << "xyz"[component - group.first] << " axis";
  out << " since the row before: must be " << (change > bound ? "<= " : ">= ") << bound << ' '
      << group.unit
      << " with the changes around it; correct the row, or give more rows of so fast a motion";
  return out.str();
}

}  // namespace

std::vector<std::string> checkChanges(const NumericTable& table, TableKind kind, double length) {
  std::vector<std::string> faults;
  const Speeds speeds(table, kind);
  const int n = static_cast<int>(table.rows.size()) - 1;
  for (const Group& group : groupsOf(kind)) {
    const double rounding = kRounding * (group.unit[0] == 'm' ? length : 1.0);
    for (int i = 0; i < n && faults.size() < kMostTableFaults; ++i) {
      double largest = 0.0, furthest = 0.0;
      Eigen::Index component = group.first;
      for (Eigen::Index k = group.first; k < group.first + group.count; ++k) {
        const auto [lo, hi] = speeds.expected(k, i);
        largest = std::max({largest, -lo, hi});
        const double off = std::max(lo - speeds.at(k, i), speeds.at(k, i) - hi);
        if (off <= furthest) continue;
        furthest = off;
        component = k;
      }
      const double spacing = table.rows[i + 1][0] - table.rows[i][0];
      const double give = kGive * largest * spacing + rounding;
      if (furthest * spacing <= give) continue;
      const auto [lo, hi] = speeds.expected(component, i);
      const double change = speeds.at(component, i) * spacing;
      const double bound = change > hi * spacing ? hi * spacing + give : lo * spacing - give;
      faults.push_back(text(table, kind, group, i, component, change, bound));
    }
  }
  return faults;
}

}  // namespace monarch_flight
