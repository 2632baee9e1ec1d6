// The coordinator's vector of unknowns, and the diagnosis in its terms.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "monarch_flight/coupling/coordinator.h"

namespace monarch_flight {
namespace {

constexpr double kScaleDecay = 0.999;     // of the running scales, per step
constexpr std::size_t kHistoryShown = 8;  // residuals in the diagnosis of a failure
constexpr const char* kNames[4] = {"x", "z", "theta_B", "theta_R"};

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

double Coordinator::loadChange(const Loads& loads, const Loads& previous) const {
  const double force = (loads.force() - previous.force()).norm();
  const double moment = (loads.moment() - previous.moment()).norm();
  return std::max(relative(force, std::max(force_scale_, loads.force().norm())),
                  relative(moment, std::max(moment_scale_, loads.moment().norm())));
}

double Coordinator::imbalance(const CouplingVector& residual,
                              const CouplingVector& increments) const {
  const CouplingVector scales = increment_scales_.cwiseMax(increments.cwiseAbs());
  return residual.cwiseAbs().cwiseQuotient(scales).maxCoeff();
}

void Coordinator::updateScales(const Loads& loads) {
  // Worth noticing: a motion by the tolerance, and the load that moves the wing by it in one step.
  const double noticed = settings_.tolerance;
  const Appendage& wing = model_.insect.right;
  const CouplingVector& scales = step_model_.scales();
  force_scale_ =
      std::max({kScaleDecay * force_scale_, loads.force().norm(), wing.m * scales[0] * noticed});
  moment_scale_ = std::max(
      {kScaleDecay * moment_scale_, loads.moment().norm(), wing.J(1, 1) * scales[3] * noticed});
  increment_scales_ =
      (kScaleDecay * increment_scales_).cwiseMax(history_[0].cwiseAbs()).cwiseMax(noticed);
  increment_scales_[0] = increment_scales_[1] =
      std::max(increment_scales_[0], increment_scales_[1]);
}

std::string Coordinator::notConverged(const CommittedStep& step, const std::string& error) const {
  const std::vector<IterationRecord>& all = step.iterations;
  const double ratio = balance_.addedMassRatio(step.guided, committed_, added_mass_);
  std::ostringstream text;
  text << "step " << step.step << " (t = " << step.t << " s) did not converge in " << all.size()
       << " sub-iterations of two attempts, the second one from a lower predictor and with smaller "
          "relaxation; last residuals:";
  for (std::size_t i = 0; i < 4; ++i) {
    const double residual = std::abs(all.back().residual[i]);
    if (!step_model_.isFree()[i]) continue;
    text << ' ' << kNames[i] << ' ' << residual
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
