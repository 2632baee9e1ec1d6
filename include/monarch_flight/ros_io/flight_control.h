#pragma once
#include <actionlib/server/action_server.h>
#include <monarch_flight/FlyAction.h>
#include <monarch_flight/FlySteps.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/coupling/run_control.h"
#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/ros_io/audience.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/run/case.h"
#include "monarch_flight/run/hold.h"
#include "monarch_flight/run/pace.h"

namespace monarch_flight {

/// A run in a person's hands: services pause, resume, step, sub_iterate, checkpoint, reset and the
/// action fly, in the coordinator's namespace (docs/protocol.md). Requests are served in threads of
/// their own and wait until the coordinator, which asks next() between its sub-iterations, has
/// obeyed. The first step waits for rviz, every step for the pace of the run.
class FlightControl : public RunControl, public StepSink {
 public:
  /// `keep_alive` is called again and again while the run is held or waits, in the coordinator's
  /// thread; it waits a moment, and throws ExchangeError when a node is lost. `stop` must outlive
  /// this.
  FlightControl(const ros::NodeHandle& node, const RunNames& names, const Case& c,
                const RunParameters& parameters, std::function<void()> keep_alive,
                const StopFlag& stop);
  ~FlightControl() override;

  Order next(std::uint32_t step, std::uint32_t iteration) override;
  void onStep(const CommittedStep& step) override;
  void onReset() override {}
  void onEnd(const std::string& failure) override;

 private:
  using Trigger = std_srvs::Trigger;
  using Server = actionlib::ActionServer<FlyAction>;
  using Goal = Server::GoalHandle;
  struct Flown {
    Goal goal;
    std::uint32_t until = 0, first = 0;                 // steps
    std::chrono::steady_clock::time_point begin, told;  // told: of the last feedback
  };
  bool onPause(Trigger::Request& request, Trigger::Response& response);
  bool onResume(Trigger::Request& request, Trigger::Response& response);
  bool onSubIterate(Trigger::Request& request, Trigger::Response& response);
  bool onCheckpointAsked(Trigger::Request& request, Trigger::Response& response);
  bool onResetAsked(Trigger::Request& request, Trigger::Response& response);
  bool onSteps(FlySteps::Request& request, FlySteps::Response& response);
  void onGoal(Goal goal);
  void onCancel(const Goal& goal);
  void awaitTurn();
  std::optional<Flown> takeGoal();
  void endGoal();

  TimeGrid time_;
  bool keeps_;  // the run makes checkpoints
  std::function<void()> keep_alive_;
  const StopFlag& stop_;
  Hold hold_;
  Audience audience_;
  Pace pace_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::unique_ptr<Server> action_;
  std::vector<ros::ServiceServer> services_;
  std::mutex goal_mutex_;
  std::optional<Flown> goal_;  // being flown
  ros::AsyncSpinner spinner_;
};

}  // namespace monarch_flight
