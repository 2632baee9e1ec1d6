#include "monarch_flight/trim/periodic_shape.h"

#include <cmath>

namespace monarch_flight {

FourierSeries periodicSeries(const std::vector<double>& samples, double period, double t_start,
                             int harmonics) {
  const std::size_t n = samples.size() - 1;
  const double slope = (samples[n] - samples[0]) / static_cast<double>(n);
  FourierSeries series;
  series.an.assign(static_cast<std::size_t>(harmonics), 0.0);
  series.bn = series.an;
  for (std::size_t k = 0; k < n; ++k) {
    const double value = samples[k] - slope * static_cast<double>(k);
    series.a0 += value / static_cast<double>(n);
    const double phase =
        2.0 * M_PI * (t_start / period + static_cast<double>(k) / static_cast<double>(n));
    for (std::size_t i = 0; i < series.an.size(); ++i) {
      const double angle = phase * static_cast<double>(i + 1);
      series.an[i] += 2.0 / static_cast<double>(n) * value * std::cos(angle);
      series.bn[i] += 2.0 / static_cast<double>(n) * value * std::sin(angle);
    }
  }
  return series;
}

FourierSeries through(FourierSeries series, double frequency, double t_start, double q, double qd) {
  if (series.an.empty()) series.an.push_back(0.0);
  if (series.bn.empty()) series.bn.push_back(0.0);
  const double w = 2.0 * M_PI * frequency * series.multiple;
  const Coordinate now = series.at(frequency, t_start);
  const double amplitude = (qd - now.qd) / w;  // of sin(w (t - t_start))
  series.an[0] -= amplitude * std::sin(w * t_start);
  series.bn[0] += amplitude * std::cos(w * t_start);
  series.a0 += q - now.q;
  return series;
}

double rateAt(const FourierSeries& series, double frequency, double t_start) {
  return series.at(frequency, t_start).qd;
}

}  // namespace monarch_flight
