// Gains from the linear maps.
#include "trim/control_gains.h"

#include <cmath>

#include "monarch_flight/math/errors.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;

}  // namespace

LinearLaw linearLaw(std::vector<LinearStage> stages, const ControlSpace& space,
                    const ControlOptions& options) {
  if (space.inputs.size() < 2) {  // one input cannot bring two means to what is wanted
    for (LinearStage& stage : stages) {
      stage.A.bottomRows(1).setZero();
      stage.B.bottomRows(1).setZero();
    }
  }
  const Eigen::VectorXd scales = space.scales();
  const Index n = scales.size(), m = static_cast<Index>(space.inputs.size()), all = n + 3 * m + 2;
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(all, all), R = Eigen::MatrixXd::Zero(m, m);
  for (Index i = 0; i < n; ++i) Q(i, i) = options.state_weight / std::pow(scales(i), 2);
  for (Index i = 0; i < 2; ++i)
    Q(all - 2 + i, all - 2 + i) = options.integral_weight / std::pow(space.integralScales()(i), 2);
  for (Index i = 0; i < m; ++i)
    R(i, i) = options.input_weight / std::pow(commandScale(space.inputs[std::size_t(i)]), 2);
  const PeriodicLqr lqr = periodicLqr(stages, Q, R);
  LinearLaw law;
  law.riccati_periods = lqr.periods;
  law.open_loop = multipliers(stages, {});
  law.closed_loop = multipliers(stages, lqr.gains);
  law.stages = std::move(stages);
  if (!lqr.converged || !(std::abs(law.closed_loop.front()) < 1.0))
    throw NumericalError("the recursion for the gains does not converge: the inputs " +
                         namesOf(space.inputs) + " cannot hold what is asked; choose others");
  const auto N = static_cast<Index>(law.stages.size());
  law.gains.inputs = space.inputs;
  law.gains.state.resize(m * N, n);
  law.gains.filter.resize(m * N, 3 * m);
  law.gains.integral.resize(m * N, 2);
  for (Index j = 0; j < N; ++j) {
    const Eigen::MatrixXd& K = lqr.gains[std::size_t(j)];
    law.gains.state.middleRows(j * m, m) = K.leftCols(n);
    law.gains.filter.middleRows(j * m, m) = K.middleCols(n, 3 * m);
    law.gains.integral.middleRows(j * m, m) = K.rightCols(2);
  }
  return law;
}

}  // namespace monarch_flight
