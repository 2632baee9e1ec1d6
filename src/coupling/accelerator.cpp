#include "monarch_flight/coupling/accelerator.h"

#include <algorithm>
#include <cmath>

namespace monarch_flight {

bool Accelerator::wantsOperator(int) const { return false; }

void Accelerator::endStep(const Trial&) {}

Proposal ConstantRelaxation::advance(const Trial& trial) {
  return {trial.d + omega_ * trial.residual, omega_, {}};
}

AitkenRelaxation::AitkenRelaxation(double omega_initial, double omega_min, double omega_max)
    : omega_initial_(omega_initial),
      omega_min_(omega_min),
      omega_max_(omega_max),
      omega_(omega_initial),
      previous_(CouplingVector::Zero()) {}

void AitkenRelaxation::beginStep(std::uint32_t) {
  omega_ = omega_initial_;
  has_previous_ = false;
}

Proposal AitkenRelaxation::advance(const Trial& trial) {
  const CouplingVector& residual = trial.residual;
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
  return {trial.d + omega_ * residual, omega_, {}};
}

std::unique_ptr<Accelerator> makeAccelerator(const CouplingSettings& settings,
                                             const StepModel& model) {
  switch (settings.relaxation) {
    case Relaxation::kConstant:
      return std::make_unique<ConstantRelaxation>(settings.omega_initial);
    case Relaxation::kAitken:
      return std::make_unique<AitkenRelaxation>(settings.omega_initial, settings.omega_min,
                                                settings.omega_max);
    case Relaxation::kIqnIls:
      return std::make_unique<IqnIls>(settings.omega_initial, settings.reuse_steps);
    case Relaxation::kAddedMass:
      break;
  }
  return std::make_unique<AddedMassNewton>(model, settings.length_scale, settings.operator_every);
}

}  // namespace monarch_flight
