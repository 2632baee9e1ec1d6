// The coordinator's vector of unknowns, and the diagnosis in its terms.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "monarch_flight/coupling/coordinator.h"

namespace monarch_flight {
namespace {

constexpr double kScaleDecay = 0.999;     // of the running scales, per step
constexpr std::size_t kHistoryShown = 8;  // residuals in the diagnosis of a failure

double relative(double change, double scale) { return change == 0.0 ? 0.0 : change / scale; }

}  // namespace

CouplingVector Coordinator::predictedIncrements() const {
  switch (levels_) {
    case 1:
      return history_[0];
    case 2:
      return 2.0 * history_[0] - history_[1];
    default:
      return 3.0 * (history_[0] - history_[1]) + history_[2];
  }
}

double Coordinator::loadChange(const PerWing<Loads>& loads, const PerWing<Loads>& previous) const {
  double largest = 0.0;
  for (Side side : model_.sides()) {
    const Loads &now = loads[side], &then = previous[side];
    const double force = (now.force() - then.force()).norm();
    const double moment = (now.moment() - then.moment()).norm();
    largest = std::max({largest, relative(force, std::max(force_scale_[side], now.force().norm())),
                        relative(moment, std::max(moment_scale_[side], now.moment().norm()))});
  }
  return largest;
}

double Coordinator::imbalance(const CouplingVector& residual,
                              const CouplingVector& increments) const {
  const CouplingVector scales = increment_scales_.cwiseMax(increments.cwiseAbs());
  return residual.cwiseAbs().cwiseQuotient(scales).maxCoeff();
}

void Coordinator::updateScales(const PerWing<Loads>& loads) {
  // Worth noticing: a motion by the tolerance, and the load that moves the wing by it in one step.
  const double noticed = settings_.tolerance;
  const CouplingVector& scales = step_model_.scales();
  for (Side side : model_.sides()) {
    const Appendage& wing = model_.insect.wings[side].plate;
    const double force = loads[side].force().norm(), moment = loads[side].moment().norm();
    double &force_scale = force_scale_[side], &moment_scale = moment_scale_[side];
    force_scale = std::max({kScaleDecay * force_scale, force, wing.m * scales[kX] * noticed});
    moment_scale =
        std::max({kScaleDecay * moment_scale, moment, wing.J(1, 1) * scales[kThetaR] * noticed});
  }
  increment_scales_ =
      (kScaleDecay * increment_scales_).cwiseMax(history_[0].cwiseAbs()).cwiseMax(noticed);
  // What flies in any direction is measured by the largest: x, y, z; roll, pitch, yaw; both wings.
  for (const auto& [first, count] : {std::pair{0, 3}, {3, 3}, {6, 2}}) {
    auto alike = increment_scales_.segment(first, count);
    alike.setConstant(alike.maxCoeff());
  }
}

std::string Coordinator::notConverged(const CommittedStep& step, const std::string& error) const {
  const std::vector<IterationRecord>& all = step.iterations;
  const double ratio = balance_.addedMassRatio(step.guided, committed_, added_mass_);
  std::ostringstream text;
  text << "step " << step.step << " (t = " << step.t << " s) did not converge in " << all.size()
       << " sub-iterations of two attempts, the second one from a lower predictor and with smaller "
          "relaxation; last residuals:";
  for (std::size_t i = 0; i < kCoordinates; ++i) {
    const double residual = std::abs(all.back().residual[i]);
    if (!model_.free[i]) continue;
    text << ' ' << kCoordinateTable[i].name << ' ' << residual
         << (residual > settings_.tolerance ? " (too large)" : " (good)") << ',';
  }
  text << " loads " << all.back().load_residual
       << (all.back().load_residual > settings_.load_tolerance ? " (too large)" : " (good)")
       << "; limits: " << settings_.tolerance << ", loads " << settings_.load_tolerance
       << "; largest residual of the last sub-iterations:";
  const std::size_t shown = std::min(all.size(), kHistoryShown);
  for (std::size_t i = all.size() - shown; i < all.size(); ++i) {
    double largest = 0.0;
    for (double residual : all[i].residual) largest = std::max(largest, std::abs(residual));
    text << ' ' << largest;
  }
  text << "; added-mass ratio (inertia of the air over that of the insect) " << ratio;
  if (!error.empty()) text << "; a solver failed: " << error;
  text << "; " << advice(ratio);
  return text.str();
}

/// What the user may change, for the strategy in use.
std::string Coordinator::advice(double ratio) const {
  std::ostringstream text;
  const bool relaxed =
      settings_.relaxation == Relaxation::kConstant || settings_.relaxation == Relaxation::kAitken;
  if (relaxed) {
    text << "set coupling/relaxation to added_mass, or lower coupling/omega_initial and "
            "coupling/omega_max (a constant factor converges below about "
         << 2.0 / (1.0 + ratio) << " at this ratio), ";
  }
  if (settings_.relaxation == Relaxation::kIqnIls)
    text << "set coupling/relaxation to added_mass, ";
  if (settings_.relaxation == Relaxation::kAddedMass) text << "lower coupling/operator_every, ";
  text << "shorten the time step, raise coupling/max_sub_iterations, or loosen the tolerance that "
          "is "
          "not met";
  return text.str();
}

}  // namespace monarch_flight
