#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "insect/smooth_spline.h"
#include "insect/time_table.h"
#include "monarch_flight/insect/gusts.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

constexpr int kSamples = 8;  // of each interval between two rows

WindRange rangeOf(const SmoothSpline& spline, const std::vector<double>& times) {
  std::vector<Eigen::Vector3d> all;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    for (int k = 0; k <= kSamples; ++k) {
      all.emplace_back(spline.at(times[i] + (times[i + 1] - times[i]) * k / kSamples).q);
    }
  }
  Eigen::Vector3d low = all.front(), high = all.front();
  for (const Eigen::Vector3d& v : all) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  WindRange range{0.5 * (low + high), 0.0};
  double step = 0.0;  // from sample to sample: what lies between is nearer than half of it
  for (std::size_t i = 0; i < all.size(); ++i) {
    range.spread = std::max(range.spread, (all[i] - range.middle).norm());
    if (i > 0) step = std::max(step, (all[i] - all[i - 1]).norm());
  }
  range.spread += 0.5 * step;
  return range;
}

}  // namespace

const std::vector<std::string>& WindSeries::columns() {
  static const std::vector<std::string> names{"t", "wx", "wy", "wz"};
  return names;
}

WindSeries::WindSeries(const NumericTable& given) {
  const NumericTable table = given.select(columns());
  const std::vector<std::string> faults = timeTableFaults(table, SmoothSpline::kLeastSamples);
  if (!faults.empty()) throw InputError(faults);
  const std::vector<double> times = table.column("t");
  Eigen::MatrixXd samples(3, times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (int k = 0; k < 3; ++k) samples(k, i) = table.rows[i][k + 1];
  }
  t_begin_ = times.front();
  t_end_ = times.back();
  spline_ = std::make_unique<const SmoothSpline>(times, samples);
  range_ = rangeOf(*spline_, times);
}

WindSeries::~WindSeries() = default;

Wind WindSeries::at(double t, const Eigen::Vector3d&, const Eigen::Vector3d&,
                    const Eigen::Vector3d&) const {
  const double rounding = 1e-9 * (t_end_ - t_begin_);
  if (!(t >= t_begin_ - rounding && t <= t_end_ + rounding)) {
    std::ostringstream text;
    text.precision(9);
    text << "t = " << t << " s lies outside the wind's table: " << t_begin_ << " to " << t_end_
         << " s";
    throw std::out_of_range(text.str());
  }
  const SmoothSpline::Value v = spline_->at(t);
  return {v.q, v.qd};
}

}  // namespace monarch_flight
