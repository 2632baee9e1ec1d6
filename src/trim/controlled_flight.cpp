#include "monarch_flight/trim/controlled_flight.h"

#include <algorithm>
#include <cmath>

#include "monarch_flight/guidance/flight_controller.h"
#include "monarch_flight/insect/heading.h"
#include "monarch_flight/insect/start_motion.h"
#include "trim/control_scales.h"
#include "trim/led_flight.h"

namespace monarch_flight {
namespace {

/// The same commands at all times.
class Constant : public CommandSource {
 public:
  explicit Constant(const WingbeatChange& command) : command_(command) {}
  void start() override {}
  std::optional<WingbeatChange> next(const WingbeatLevel&) override { return command_; }

 private:
  WingbeatChange command_;
};

/// Cuts a flight into flaps of its phase clock.
class FlapSink : public StepSink {
 public:
  explicit FlapSink(ControlledFlight& flight) : flight_(flight) {}
  void onStep(const CommittedStep& step) override {
    const Eigen::Vector3d& x = step.interface.body.x;
    if (step.step > 0) add(step);
    if (step.step == 0 || std::floor(step.guidance.phase + 1e-6) > flap_) {
      if (step.step > 0) finish(step, x);
      flap_ = std::floor(step.guidance.phase + 1e-6);
      begin_ = x;
      t_begin_ = step.t;
      now_ = {};
      levels_ = 0;
    }
    clipped_ = step.guidance.clipped;
    flight_.lost = step.guidance.lost;
  }
  void onReset() override {}
  void onEnd(const std::string&) override {}

 private:
  void add(const CommittedStep& step) {
    const double theta = step.interface.body.pitch.q;
    const WingbeatChange& c = step.guidance.command;
    now_.theta_B_low = levels_ == 0 ? theta : std::min(now_.theta_B_low, theta);
    now_.theta_B_high = levels_ == 0 ? theta : std::max(now_.theta_B_high, theta);
    now_.theta_B_mean += theta;
    const HeadingMotion body = headingMotion(step.interface.body);
    now_.roll_low = levels_ == 0 ? body.roll.q : std::min(now_.roll_low, body.roll.q);
    now_.roll_high = levels_ == 0 ? body.roll.q : std::max(now_.roll_high, body.roll.q);
    now_.side_velocity += body.velocity.y();
    now_.turn += std::remainder(body.yaw.q - heading_, 2.0 * M_PI);
    heading_ = body.yaw.q;
    for (const CommandInfo& info : kCommandTable) {
      double &low = now_.command_low.*info.value, &high = now_.command_high.*info.value;
      low = levels_ == 0 ? c.*info.value : std::min(low, c.*info.value);
      high = levels_ == 0 ? c.*info.value : std::max(high, c.*info.value);
    }
    now_.limited = now_.limited || step.guidance.clipped > clipped_;
    ++levels_;
  }
  void finish(const CommittedStep& step, const Eigen::Vector3d& x) {
    const Eigen::Vector3d v = (x - begin_) / (step.t - t_begin_);
    now_.speed = v.norm();
    now_.climb = std::atan2(-v.z(), v.y() == 0.0 ? v.x() : std::hypot(v.x(), v.y()));
    now_.theta_B_mean /= levels_;
    now_.side_velocity /= levels_;
    flight_.flaps.push_back(now_);
  }

  ControlledFlight& flight_;
  ControlledFlap now_;
  double flap_ = 0.0, t_begin_ = 0.0, heading_ = 0.0;
  Eigen::Vector3d begin_;
  int levels_ = 0;
  unsigned clipped_ = 0;
};

}  // namespace

ControlledFlight flyControlled(const Case& given, const WingbeatSettings& wingbeat,
                               const ControllerSettings& controller, const ControlledStart& start) {
  Case c = given;
  c.output.surface_every = c.output.flow_every = c.output.fields_every = 0;
  c.coupling.prescribed_steps = 0;
  c.coupling.accelerations_known = false;
  c.time.steps = static_cast<std::uint32_t>(std::lround(start.flaps * c.time.stepsPerFlap()));
  TrimReference reference;
  reference.commands.setZero(static_cast<Eigen::Index>(controller.gains.inputs.size()));
  reference.state.setZero(controller.states());
  reference.next = reference.state;
  const int phase = static_cast<int>(
      std::lround(controller.samples * (c.time.t_start / c.time.period)) % controller.samples);
  controller.table.at(controller.set_points.front().velocity(), phase, reference);
  FlapState s = with(FlapState::Zero(), reference.state);
  if (controller.lateral) s = changedAside(s, controller.lateral->states.row(phase));
  s += start.change;
  c.motion = std::make_shared<StartMotion>(
      c.motion, startOf(c.free, Eigen::Vector3d::Zero(), s, FlapState::Zero()), c.time.t_start);
  std::unique_ptr<CommandSource> source;
  if (start.uncontrolled) {
    WingbeatChange trim;
    const auto set = [&trim](const FeedbackGains& gains, const Eigen::VectorXd& commands) {
      for (Eigen::Index i = 0; i < gains.size(); ++i)
        trim.*kCommandTable[gains.inputs[static_cast<std::size_t>(i)]].value = commands(i);
    };
    set(controller.gains, reference.commands);
    if (controller.lateral) set(controller.lateral->gains, controller.lateral->commands);
    source = std::make_unique<Constant>(trim);
  } else {
    source = std::make_unique<FlightController>(controller);
  }
  ControlledFlight flight;
  FlapSink sink(flight);
  const RunResult result =
      flyLed(c,
             std::make_unique<WingbeatGuidance>(c.motion, start.wind, wingbeat, c.time.t_start,
                                                std::move(source)),
             {&sink});
  flight.complete = result.complete;
  flight.failure = result.failure;
  return flight;
}

}  // namespace monarch_flight
