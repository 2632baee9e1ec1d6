#pragma once
#include <vector>

#include "monarch_flight/insect/fourier_motion.h"

namespace monarch_flight {

/// Periodic part of samples over one period, q(t_start + k T/N), k = 0..N (both ends): what a
/// straight line through both ends leaves, as `harmonics` terms in w t (not w (t - t_start)), w =
/// 2 pi / period.
FourierSeries periodicSeries(const std::vector<double>& samples, double period, double t_start,
                             int harmonics);

/// The series with mean and first harmonic changed so that value and rate at t_start are these.
FourierSeries through(FourierSeries series, double frequency, double t_start, double q, double qd);

/// The series with its rate at t_start: what must be taken off a constant velocity that carries it.
double rateAt(const FourierSeries& series, double frequency, double t_start);

}  // namespace monarch_flight
