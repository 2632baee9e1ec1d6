#include "monarch_flight/ros_io/flight_control.h"

#include <iostream>
#include <limits>
#include <thread>

#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

// A step may run while reset or pause are asked for; further requests wait.
constexpr std::uint32_t kThreads = 4;
constexpr std::chrono::milliseconds kFeedback{100};  // between two of them
constexpr std::chrono::milliseconds kShortWait{10};  // so long nobody need be kept alive
constexpr char kFlies[] = "; pause it first";

using Status = actionlib_msgs::GoalStatus;

bool answer(const RunPlace& place, bool good, std_srvs::Trigger::Response& response,
            const char* advice = "") {
  response.success = good && !place.ended;
  response.message = place.describe() + (place.ended ? "" : advice);
  return true;
}

FlyResult resultOf(const RunPlace& place, std::uint32_t steps) {
  FlyResult result;
  result.step = place.step;
  result.complete = place.ended && place.failure.empty() && place.step == steps;
  result.message = place.describe();
  return result;
}

}  // namespace

FlightControl::FlightControl(const ros::NodeHandle& node, const RunNames& names, const Case& c,
                             const RunParameters& parameters, std::function<void()> keep_alive,
                             const StopFlag& stop)
    : time_(c.time),
      keeps_(c.output.checkpoint_every > 0),
      keep_alive_(std::move(keep_alive)),
      stop_(stop),
      hold_(parameters.paused),
      audience_(names, parameters.rviz),
      pace_(parameters.rate, c.time.dt),
      node_(node),
      spinner_(kThreads, &queue_) {
  node_.setCallbackQueue(&queue_);
  action_ = std::make_unique<Server>(
      node_, "fly", [this](const Goal& goal) { onGoal(goal); },
      [this](const Goal& goal) { onCancel(goal); }, false);
  action_->start();
  services_ = {node_.advertiseService("pause", &FlightControl::onPause, this),
               node_.advertiseService("resume", &FlightControl::onResume, this),
               node_.advertiseService("step", &FlightControl::onSteps, this),
               node_.advertiseService("sub_iterate", &FlightControl::onSubIterate, this),
               node_.advertiseService("checkpoint", &FlightControl::onCheckpointAsked, this),
               node_.advertiseService("reset", &FlightControl::onResetAsked, this)};
  spinner_.start();
  if (parameters.paused)
    std::cout << "held at the start: call the service " << node_.resolveName("resume") << " or "
              << node_.resolveName("step") << " to fly" << std::endl;
}

FlightControl::~FlightControl() {
  hold_.end("the coordinator has left");  // nobody waits any longer
  spinner_.stop();
}

RunControl::Order FlightControl::next(std::uint32_t step, std::uint32_t iteration) {
  if (iteration == 0) {
    awaitTurn();
    pace_.begin(step, Pace::Clock::now());
  }
  return hold_.next(step, iteration, stop_, [this](const RunPlace&) {
    endGoal();
    keep_alive_();
  });
}

/// What a person wants comes first.
void FlightControl::awaitTurn() {
  while (!stop_ && !hold_.wanted()) {
    const Pace::Clock::duration left = pace_.left(Pace::Clock::now());
    if (!audience_.ready() || left > kShortWait)
      keep_alive_();
    else if (left > Pace::Clock::duration::zero())
      std::this_thread::sleep_for(left);
    else
      return;
  }
}

bool FlightControl::onPause(Trigger::Request&, Trigger::Response& response) {
  const RunPlace place = hold_.pause();
  return answer(place, place.held, response);
}

bool FlightControl::onResume(Trigger::Request&, Trigger::Response& response) {
  const RunPlace place = hold_.resume();
  return answer(place, !place.held, response);
}

bool FlightControl::onSubIterate(Trigger::Request&, Trigger::Response& response) {
  const RunPlace place = hold_.subIterate();
  return answer(place, place.held, response, place.held ? "" : kFlies);
}

bool FlightControl::onCheckpointAsked(Trigger::Request&, Trigger::Response& response) {
  if (!keeps_) {
    response.message =
        "checkpoint_every = 0: this run keeps no checkpoints; start it with another value";
    return true;
  }
  const RunPlace place = hold_.checkpoint();
  answer(place, true, response);
  if (response.success) {
    response.message = "checkpoint of step " + std::to_string(place.step) + "; " + response.message;
  }
  return true;
}

bool FlightControl::onResetAsked(Trigger::Request&, Trigger::Response& response) {
  return answer(hold_.reset(), true, response);
}

bool FlightControl::onSteps(FlySteps::Request& request, FlySteps::Response& response) {
  if (request.steps == 0) {
    response.message = "steps = 0: must be at least 1";
    return true;
  }
  const std::uint32_t before = hold_.place().step;
  const RunPlace place = hold_.steps(request.steps);
  response.step = place.step;
  response.success = place.step == before + request.steps && (place.held || place.ended);
  response.message = place.describe() + (place.held || place.ended ? "" : kFlies);
  return true;
}

void FlightControl::onGoal(Goal goal) {
  const std::uint32_t asked = goal.getGoal()->until_step;
  const RunPlace place = hold_.place();
  std::string refusal;
  if (place.ended) refusal = place.describe();
  if (asked != 0 && (asked <= place.step || asked > time_.steps)) {
    refusal = "until_step = " + std::to_string(asked) + ": must be 0, or from " +
              std::to_string(place.step + 1) + " to " + std::to_string(time_.steps);
  }
  const std::lock_guard<std::mutex> lock(goal_mutex_);
  if (goal_) refusal = "another goal is being flown: cancel it first";
  if (!refusal.empty()) {
    FlyResult result = resultOf(place, time_.steps);
    result.message = refusal;
    goal.setRejected(result, refusal);
    return;
  }
  goal.setAccepted();
  hold_.flyUntil(asked == 0 ? std::numeric_limits<std::uint32_t>::max() : asked);
  goal_ = Flown{
      goal, asked == 0 ? time_.steps : asked, place.step, std::chrono::steady_clock::now(), {}};
}

void FlightControl::onCancel(const Goal&) { hold_.pauseSoon(); }

std::optional<FlightControl::Flown> FlightControl::takeGoal() {
  const std::lock_guard<std::mutex> lock(goal_mutex_);
  std::optional<Flown> taken;
  taken.swap(goal_);
  return taken;
}

/// The run is held: the goal has been reached, was cancelled, or somebody else has paused. A goal
/// that has let it go meanwhile stays.
void FlightControl::endGoal() {
  std::optional<Flown> flown;
  RunPlace place;
  {
    const std::lock_guard<std::mutex> lock(goal_mutex_);
    place = hold_.place();
    if (!place.held) return;
    flown.swap(goal_);
  }
  if (!flown) return;
  const FlyResult result = resultOf(place, time_.steps);
  if (place.step == flown->until) {
    flown->goal.setSucceeded(result, result.message);
  } else if (flown->goal.getGoalStatus().status == Status::PREEMPTING) {
    flown->goal.setCanceled(result, result.message);
  } else {
    flown->goal.setAborted(result, result.message);
  }
}

void FlightControl::onStep(const CommittedStep& step) {
  hold_.committed(step.step);
  const std::lock_guard<std::mutex> lock(goal_mutex_);
  if (!goal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - goal_->told < kFeedback) return;
  goal_->told = now;
  if (step.step < goal_->first) goal_->first = step.step;  // after a reset
  FlyFeedback feedback;
  feedback.flap = time_.period > 0.0 ? step.step * time_.dt / time_.period : 0.0;
  feedback.step = step.step;
  feedback.sub_iterations = static_cast<std::uint32_t>(step.iterations.size());
  const double done = std::max(step.step - goal_->first, 1u);
  feedback.time_left_s = secondsSince(goal_->begin) / done * (goal_->until - step.step);
  goal_->goal.publishFeedback(feedback);
}

void FlightControl::onEnd(const std::string& failure) {
  hold_.end(failure);
  std::optional<Flown> flown = takeGoal();
  if (!flown) return;
  const FlyResult result = resultOf(hold_.place(), time_.steps);
  if (failure.empty()) {
    flown->goal.setSucceeded(result, result.message);
  } else {
    flown->goal.setAborted(result, result.message);
  }
}

}  // namespace monarch_flight
