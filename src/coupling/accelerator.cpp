#include "monarch_flight/coupling/accelerator.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {

double ConstantRelaxation::advance(CouplingVector& d, const CouplingVector& residual) {
  d += omega_ * residual;
  return omega_;
}

AitkenRelaxation::AitkenRelaxation(double omega_initial, double omega_min, double omega_max)
    : omega_initial_(omega_initial),
      omega_min_(omega_min),
      omega_max_(omega_max),
      omega_(omega_initial),
      previous_(CouplingVector::Zero()) {}

void AitkenRelaxation::reset() {
  omega_ = omega_initial_;
  has_previous_ = false;
}

double AitkenRelaxation::advance(CouplingVector& d, const CouplingVector& residual) {
  if (has_previous_) {
    const CouplingVector change = residual - previous_;
    const double factor = -omega_ * previous_.dot(change) / change.squaredNorm();
    // 0/0 where the residual did not change: nothing learnt, the factor stays.
    if (std::isfinite(factor)) {
      omega_ = std::copysign(std::clamp(std::abs(factor), omega_min_, omega_max_), factor);
    }
  }
  previous_ = residual;
  has_previous_ = true;
  d += omega_ * residual;
  return omega_;
}

std::unique_ptr<Accelerator> makeAccelerator(const CouplingSettings& settings) {
  if (settings.relaxation == Relaxation::kConstant) {
    return std::make_unique<ConstantRelaxation>(settings.omega_initial);
  }
  return std::make_unique<AitkenRelaxation>(settings.omega_initial, settings.omega_min,
                                            settings.omega_max);
}

}  // namespace monarch_flight
