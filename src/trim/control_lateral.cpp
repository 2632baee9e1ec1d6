// The heading's law, and the turn without side-slip.
#include <cmath>

#include "monarch_flight/math/errors.h"
#include "trim/control_gains.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kHeadingState = 3;
constexpr double kMet = 1e-6;  // of the conditions of a turn of one rad a flap

/// The steady turn of the linear maps at one rad a flap: commands held, everything but the heading
/// the same after a flap, and no side velocity in the mean if there is an input for it.
struct Turn {
  VectorXd commands;
  MatrixXd states;  // a row a sample
};

Turn steadyTurn(const std::vector<LinearStage>& stages, const ControlSpace& space) {
  const Index n = space.scales().size(), m = static_cast<Index>(space.inputs.size());
  const Index all = stages.front().A.rows();
  // Everything is linear in the start (heading 0) and in the commands; the filters are at rest.
  const Index unknowns = n + m;
  MatrixXd x = MatrixXd::Zero(all, unknowns), u = MatrixXd::Zero(m, unknowns);
  x.topLeftCorner(n, n).setIdentity();
  for (Index i = 0; i < m; ++i) x(n + 3 * i, n + i) = u(i, n + i) = 1.0;
  std::vector<MatrixXd> states;
  for (const LinearStage& stage : stages) {
    states.push_back(x.topRows(n));
    x = (stage.A * x + stage.B * u).eval();
  }
  MatrixXd conditions(n + 2, unknowns);
  VectorXd wanted = VectorXd::Zero(n + 2);
  conditions.topRows(n) = x.topRows(n) - states.front();  // of the heading: the turn
  wanted(kHeadingState) = 1.0;
  conditions.row(n) = x.row(all - 1);  // side velocity
  conditions.row(n + 1).setZero();
  conditions(n + 1, kHeadingState) = 1.0;  // the heading begins at 0
  if (m < 2) conditions.row(n).setZero();
  VectorXd scales(unknowns);
  scales.head(n) = space.scales();
  for (Index i = 0; i < m; ++i)
    scales(n + i) = commandScale(space.inputs[static_cast<std::size_t>(i)]);
  const MatrixXd scaled = conditions * scales.asDiagonal();
  const VectorXd y = scales.cwiseProduct(scaled.completeOrthogonalDecomposition().solve(wanted));
  if (!((conditions * y - wanted).norm() < kMet))
    throw NumericalError("no steady turn by " + namesOf(space.inputs) +
                         "; choose other lateral_inputs");
  Turn turn{y.tail(m), MatrixXd(static_cast<Index>(stages.size()), n)};
  for (std::size_t j = 0; j < states.size(); ++j)
    turn.states.row(static_cast<Index>(j)) = (states[j] * y).transpose();
  // Of the heading only what it does about its mean way.
  auto heading = turn.states.col(kHeadingState);
  for (Index j = 0; j < heading.size(); ++j)
    heading(j) -= static_cast<double>(j) / static_cast<double>(heading.size());
  heading.array() -= heading.mean();
  return turn;
}

}  // namespace

void designLateral(ControlDesign& design, const PhaseMap& map, const ControlTrim& trim,
                   const std::vector<FlapState>& orbit, const WingbeatStart& wingbeat) {
  const ControlOptions& options = design.options;
  const auto space = lateralSpace(map.baseCase(), options.lateral_inputs);
  const std::vector<LinearStage> stages = linearise(map, *space, orbit, wingbeat);
  design.lateral = linearLaw(stages, *space, options);
  const Index n = space->scales().size(), m = static_cast<Index>(space->inputs.size());
  const Turn turn = steadyTurn(stages, *space);
  LateralSettings s{design.lateral->gains, options.turn,      turn.commands,
                    turn.states,           VectorXd::Zero(m), MatrixXd::Zero(options.samples, n)};
  if (!trim.symmetric) {
    for (Index i = 0; i < m; ++i)
      s.commands(i) =
          trim.wingbeat.command.*kCommandTable[space->inputs[static_cast<std::size_t>(i)]].value;
    for (std::size_t j = 0; j < trim.orbit.size(); ++j)
      s.states.row(static_cast<Index>(j)) =
          lateralState(trim.orbit[j], trim.headings[j]).head(n).transpose();
  }
  design.settings.lateral = s;
}

}  // namespace monarch_flight
