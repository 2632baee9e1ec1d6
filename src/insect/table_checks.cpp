#include "insect/table_checks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "insect/smooth_spline.h"
#include "monarch_flight/math/angle.h"

namespace monarch_flight {
namespace {

constexpr double kUnitTolerance = 1e-4;
constexpr int kFirstQuaternion = 4;  // columns of a table of wings
constexpr int kFirstAngle = 4;       // columns of a table of bodies

/// Checks unit length, and normalises.
void checkLengths(NumericTable& table, std::vector<std::string>& faults) {
  for (std::size_t i = 0; i < table.rows.size() && faults.size() < kMostTableFaults; ++i) {
    Eigen::Map<Eigen::Vector4d> q(table.rows[i].data() + kFirstQuaternion);
    const double norm = q.norm();
    if (std::abs(norm - 1.0) > kUnitTolerance) {
      std::ostringstream text;
      text << tablePlace(table, i, "qw..qz") << ": length " << norm << ": must be 1 within "
           << kUnitTolerance << "; normalise the quaternion";
      faults.push_back(text.str());
    } else {
      q /= norm;
    }
  }
}

/// The turn from row to row; signs are continuous.
void checkTurns(const NumericTable& table, std::vector<std::string>& faults) {
  for (std::size_t i = 1; i < table.rows.size() && faults.size() < kMostTableFaults; ++i) {
    const Eigen::Map<const Eigen::Vector4d> before(table.rows[i - 1].data() + kFirstQuaternion);
    const Eigen::Map<const Eigen::Vector4d> q(table.rows[i].data() + kFirstQuaternion);
    if (q.dot(before) >= std::cos(M_PI / 4.0)) continue;
    std::ostringstream text;
    text << tablePlace(table, i, "qw..qz") << ": turned by "
         << 2.0 * std::acos(std::min(1.0, q.dot(before))) * 180.0 / M_PI
         << " deg since the row before: must be <= 90; give more rows";
    faults.push_back(text.str());
  }
}

}  // namespace

void makeContinuous(NumericTable& table, TableKind kind) {
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const std::vector<double>& before = table.rows[i - 1];
    std::vector<double>& row = table.rows[i];
    if (kind == TableKind::kWing) {
      const Eigen::Map<const Eigen::Vector4d> last(before.data() + kFirstQuaternion);
      Eigen::Map<Eigen::Vector4d> q(row.data() + kFirstQuaternion);
      if (q.dot(last) < 0.0) q = -q;
      continue;
    }
    for (std::size_t k = kFirstAngle; k < row.size(); ++k) {
      const double turns = std::round((row[k] - before[k]) / (2.0 * M_PI));
      if (turns != 0.0) row[k] -= turns * 2.0 * M_PI;
    }
  }
}

std::vector<std::string> checkTable(NumericTable& table, TableKind kind, double length) {
  std::vector<std::string> faults = timeTableFaults(table, SmoothSpline::kLeastSamples);
  if (faults.empty() && kind == TableKind::kWing) checkLengths(table, faults);
  if (!faults.empty()) return faults;
  makeContinuous(table, kind);
  if (kind == TableKind::kWing) checkTurns(table, faults);
  if (!faults.empty()) return faults;
  return checkChanges(table, kind, length);
}

}  // namespace monarch_flight
