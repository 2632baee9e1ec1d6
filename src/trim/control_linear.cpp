// The linear maps between samples.
#include "monarch_flight/math/errors.h"
#include "monarch_flight/trim/trim.h"
#include "trim/control_gains.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kPart = 0.1;  // of a scale: the differences

/// States, filters and commands of a space as one vector, and the flight over a sample as a
/// function of it.
class SampleFlight {
 public:
  SampleFlight(const PhaseMap& map, const ControlSpace& space, int phase, const FlapState& state,
               const WingbeatStart& wingbeat)
      : map_(map), space_(space), phase_(phase), state_(state), wingbeat_(wingbeat) {
    n_ = space.scales().size();
    m_ = static_cast<Index>(space.inputs.size());
  }
  Index size() const { return n_ + 4 * m_; }

  VectorXd scales() const {
    VectorXd s(size());
    s.head(n_) = space_.scales();
    const double rate = 1.0 / map_.timeConstant();
    for (Index i = 0; i < m_; ++i) {
      const double scale = commandScale(space_.inputs[static_cast<std::size_t>(i)]);
      s.segment<3>(n_ + 3 * i) << scale, scale * rate, scale * rate * rate;
      s(n_ + 3 * m_ + i) = scale;
    }
    return s;
  }

  /// States, filters, means at the end for a change of the start.
  VectorXd end(const VectorXd& change) const {
    const VectorXd states = change.head(n_);
    WingbeatStart wingbeat = wingbeat_;
    for (Index i = 0; i < m_; ++i) {
      const std::size_t k = space_.inputs[static_cast<std::size_t>(i)];
      Coordinate& c = wingbeat.filters[k];
      c.q += change(n_ + 3 * i);
      c.qd += change(n_ + 3 * i + 1);
      c.qdd += change(n_ + 3 * i + 2);
      wingbeat.command.*kCommandTable[k].value += change(n_ + 3 * m_ + i);
    }
    const PhaseFlight flight = map_.fly(phase_, space_.changed(state_, states), wingbeat, 1);
    if (!flight.complete) throw NumericalError("a flight over a sample fails: " + flight.failure);
    VectorXd out(n_ + 3 * m_ + 2);
    out.head(n_) = space_.end(flight, states);
    for (Index i = 0; i < m_; ++i) {
      const Coordinate& c = flight.wingbeat.filters[space_.inputs[static_cast<std::size_t>(i)]];
      out.segment<3>(n_ + 3 * i) << c.q, c.qd, c.qdd;
    }
    out.tail<2>() = space_.means(flight, states);
    return out;
  }

 private:
  const PhaseMap& map_;
  const ControlSpace& space_;
  int phase_;
  const FlapState& state_;
  const WingbeatStart& wingbeat_;
  Index n_ = 0, m_ = 0;
};

}  // namespace

std::vector<LinearStage> linearise(const PhaseMap& map, const ControlSpace& space,
                                   const std::vector<FlapState>& orbit,
                                   const WingbeatStart& wingbeat) {
  std::vector<LinearStage> stages;
  const auto m = static_cast<Index>(space.inputs.size());
  for (int phase = 0; phase < map.samples(); ++phase) {
    const SampleFlight flight(map, space, phase, orbit[static_cast<std::size_t>(phase)], wingbeat);
    const Index own = flight.size() - m, all = own + 2;
    const VectorXd scales = flight.scales();
    Eigen::MatrixXd J(all, flight.size());
    for (Index i = 0; i < flight.size(); ++i) {
      VectorXd change = VectorXd::Zero(flight.size());
      change(i) = kPart * scales(i);
      J.col(i) = (flight.end(change) - flight.end(-change)) / (2.0 * change(i));
    }
    LinearStage stage{Eigen::MatrixXd::Zero(all, all), Eigen::MatrixXd::Zero(all, m)};
    J.bottomRows(2) /= map.samples();  // the integral over a sample
    stage.A.leftCols(own) = J.leftCols(own);
    stage.A.bottomRightCorner(2, 2).setIdentity();
    stage.B = J.rightCols(m);
    stages.push_back(stage);
  }
  return stages;
}

}  // namespace monarch_flight
