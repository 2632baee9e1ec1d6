#include "monarch_flight/guidance/feedback_law.h"

#include <utility>

namespace monarch_flight {

std::string namesOf(const std::vector<std::size_t>& inputs) {
  std::string names;
  for (std::size_t input : inputs)
    names += (names.empty() ? "" : ", ") + std::string(kCommandTable[input].name);
  return names;
}

FeedbackLaw::FeedbackLaw(FeedbackGains gains) : gains_(std::move(gains)) {
  asked_ = excess_ = reference_ = ControlInput::Zero(gains_.size());
  start();
}

void FeedbackLaw::start() {
  integral_.setZero();
  asked_.setZero();
  excess_.setZero();
}

bool FeedbackLaw::limited(const WingbeatChange& taken) {
  for (std::size_t i = 0; i < gains_.inputs.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    excess_(k) = asked_(k) - taken.*kCommandTable[gains_.inputs[i]].value;
  }
  return (excess_.array() != 0.0).any();
}

void FeedbackLaw::integrate(int phase, const Eigen::Vector2d& step) {
  const Eigen::Index m = gains_.size();
  const auto gain = gains_.integral.middleRows(phase * m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const double drive = -(gain(i, 0) * step.x() + gain(i, 1) * step.y());
    if (drive * excess_(i) > 0.0) return;
  }
  integral_ += step;
}

void FeedbackLaw::feedBack(int phase, const Eigen::Ref<const Eigen::VectorXd>& deviation,
                           const std::array<Coordinate, kCommands>& applied) {
  const Eigen::Index m = gains_.size();
  reference_ = asked_;
  asked_.noalias() -= gains_.state.middleRows(phase * m, m) * deviation;
  asked_.noalias() -= gains_.integral.middleRows(phase * m, m) * integral_;
  const auto gain = gains_.filter.middleRows(phase * m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Coordinate& c = applied[gains_.inputs[static_cast<std::size_t>(i)]];
    asked_ -= gain.col(3 * i) * (c.q - reference_(i)) + gain.col(3 * i + 1) * c.qd +
              gain.col(3 * i + 2) * c.qdd;
  }
}

void FeedbackLaw::write(WingbeatChange& change) const {
  for (std::size_t i = 0; i < gains_.inputs.size(); ++i)
    change.*kCommandTable[gains_.inputs[i]].value = asked_(static_cast<Eigen::Index>(i));
}

void FeedbackLaw::memory(StateVisitor& state, const std::string& owner) {
  state((owner + "_integral").c_str(), integral_);
  state((owner + "_asked").c_str(), asked_);
}

}  // namespace monarch_flight
