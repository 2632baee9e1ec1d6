#include "monarch_flight/guidance/replay_guidance.h"

#include <stdexcept>

namespace monarch_flight {
namespace {

/// Reads the numbers of a row one after the other.
class Row {
 public:
  explicit Row(const std::vector<double>& values) : values_(values) {}
  double number() { return values_[at_++]; }
  Coordinate coordinate() {
    const double q = number(), qd = number(), qdd = number();
    return {q, qd, qdd};
  }
  Eigen::Vector3d vector() {
    const Coordinate c = coordinate();
    return {c.q, c.qd, c.qdd};
  }

 private:
  const std::vector<double>& values_;
  std::size_t at_ = 0;
};

}  // namespace

const std::vector<std::string>& ReplayGuidance::columns() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = {"t",
                                      "phi",
                                      "phi_dot",
                                      "phi_ddot",
                                      "psi",
                                      "psi_dot",
                                      "psi_ddot",
                                      "theta_R",
                                      "theta_R_dot",
                                      "theta_R_ddot",
                                      "rest_angle",
                                      "phi_L",
                                      "phi_L_dot",
                                      "phi_L_ddot",
                                      "psi_L",
                                      "psi_L_dot",
                                      "psi_L_ddot",
                                      "theta_L",
                                      "theta_L_dot",
                                      "theta_L_ddot",
                                      "rest_angle_L",
                                      "theta_A",
                                      "theta_A_dot",
                                      "theta_A_ddot",
                                      "wx",
                                      "wy",
                                      "wz",
                                      "wax",
                                      "way",
                                      "waz",
                                      "phase",
                                      "clipped",
                                      "refused",
                                      "lost"};
    for (const char* kind : {"command_", "applied_"}) {
      for (const CommandInfo& info : kCommandTable) names.push_back(std::string(kind) + info.name);
    }
    return names;
  }();
  return all;
}

PrescribedState ReplayGuidance::at(std::uint32_t step, double t) {
  if (step >= table_->rows.size()) {
    throw std::out_of_range(table_->name + ": holds " + std::to_string(table_->rows.size()) +
                            " levels, so none for step " + std::to_string(step));
  }
  Row row(table_->rows[step]);
  row.number();  // t
  PrescribedState state = motion_->at(t);
  for (Side side : kSides) {
    WingAngles& wing = state.angles.wings[side];
    wing.phi = row.coordinate();
    wing.psi = row.coordinate();
    wing.theta = row.coordinate();
    state.rest_angle[side] = row.number();
  }
  state.angles.theta_A = row.coordinate();
  state.wind.v = row.vector();
  state.wind.a = row.vector();
  report_.phase = row.number();
  report_.clipped = static_cast<unsigned>(row.number());
  report_.refused = static_cast<unsigned>(row.number());
  report_.lost = row.number() != 0.0;
  for (WingbeatChange* change : {&report_.command, &report_.applied}) {
    for (const CommandInfo& info : kCommandTable) change->*info.value = row.number();
  }
  return state;
}

}  // namespace monarch_flight
