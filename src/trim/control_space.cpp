#include "trim/control_space.h"

#include "monarch_flight/guidance/controller_settings.h"
#include "trim/control_scales.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class InPlane : public ControlSpace {
 public:
  InPlane(const Case& c, std::vector<std::size_t> inputs)
      : ControlSpace(std::move(inputs)), n_(controlStates(c)) {}
  VectorXd scales() const override { return VectorXd(trimScales()).head(n_); }
  Eigen::Vector2d integralScales() const override { return {0.1, 0.1}; }  // [m/s flaps]
  FlapState changed(FlapState s, const VectorXd& change) const override {
    for (int i = 0; i < n_; ++i) s(i) += change(i);
    for (int i = 4; i < n_; ++i) s(i + 6) += change(i);
    return s;
  }
  VectorXd end(const PhaseFlight& flight, const VectorXd&) const override {
    FlapState s = flight.states.back();
    s.segment<2>(4) = 0.5 * (s.segment<2>(4) + s.tail<2>());
    return VectorXd(s).head(n_);
  }
  Eigen::Vector2d means(const PhaseFlight& flight, const VectorXd&) const override {
    return flight.velocity;
  }

 private:
  int n_;
};

class Lateral : public ControlSpace {
 public:
  Lateral(const Case& c, std::vector<std::size_t> inputs)
      : ControlSpace(std::move(inputs)),
        n_(c.free[kThetaR] ? kLateralStates : kLateralStates - 2) {}
  VectorXd scales() const override {
    VectorXd all(kLateralStates);
    all << 0.1, 0.1, 5.0, 0.1, 5.0, 0.1, 10.0;
    return all.head(n_);
  }
  Eigen::Vector2d integralScales() const override { return {0.1, 0.1}; }  // [rad flaps, m/s flaps]
  FlapState changed(FlapState s, const VectorXd& change) const override {
    return changedAside(s, change);
  }
  VectorXd end(const PhaseFlight& flight, const VectorXd& change) const override {
    return lateralState(flight.states.back(), change(3) + flight.sideways.turn).head(n_);
  }
  Eigen::Vector2d means(const PhaseFlight& flight, const VectorXd& change) const override {
    return {change(3) + flight.sideways.mean_heading, flight.sideways.mean_velocity};
  }

 private:
  int n_;
};

}  // namespace

VectorXd lateralState(const FlapState& s, double heading) {
  VectorXd x(kLateralStates);
  x << s(6), s(7), s(8), heading, s(9), 0.5 * (s(4) - s(10)), 0.5 * (s(5) - s(11));
  return x;
}

FlapState changedAside(FlapState s, const VectorXd& change) {
  s(6) += change(0);
  s(7) += change(1);
  s(8) += change(2);
  s(9) += change(4);
  for (Index i = 5; i < change.size(); ++i) {
    s(i - 1) += change(i);
    s(i + 5) -= change(i);
  }
  return s;
}

std::unique_ptr<ControlSpace> inPlaneSpace(const Case& c, std::vector<std::size_t> inputs) {
  return std::make_unique<InPlane>(c, std::move(inputs));
}

std::unique_ptr<ControlSpace> lateralSpace(const Case& c, std::vector<std::size_t> inputs) {
  return std::make_unique<Lateral>(c, std::move(inputs));
}

}  // namespace monarch_flight
