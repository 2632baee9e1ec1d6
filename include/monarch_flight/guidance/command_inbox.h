#pragma once
#include <functional>
#include <memory>
#include <mutex>

#include "monarch_flight/guidance/command_source.h"

namespace monarch_flight {

/// Where commands wait for the run: the newest one counts. Any thread may post.
class CommandInbox {
 public:
  struct Posted {
    WingbeatChange change;
    bool at_once = false;  ///< in the next step; else when the next flap begins
  };
  /// `heard` is called with every command that is posted, by who posts it.
  explicit CommandInbox(std::function<void(const WingbeatChange&)> heard = nullptr)
      : heard_(std::move(heard)) {}
  void post(const WingbeatChange& change, bool at_once);
  /// What was posted since the last call, and empties the box.
  std::optional<Posted> take();

 private:
  std::function<void(const WingbeatChange&)> heard_;
  std::mutex mutex_;
  std::optional<Posted> newest_;
};

/// Leads the wingbeat by what arrives in an inbox: a person's commands, or a node's. A start
/// empties the box, so that a run that is set back is not led by what was meant for the one before.
/// A run that goes on from a checkpoint knows the command that waits for the next flap, but not one
/// that came within the step that was not committed.
class PostedCommands : public CommandSource {
 public:
  explicit PostedCommands(std::shared_ptr<CommandInbox> inbox) : inbox_(std::move(inbox)) {}
  void start() override;
  std::optional<WingbeatChange> next(const WingbeatLevel& level) override;
  void memory(StateVisitor& state) override;

 private:
  std::shared_ptr<CommandInbox> inbox_;
  bool waiting_ = false;
  CommandInbox::Posted posted_;  // when waiting_
  double flap_ = 0.0;            // of the last level; below that of any level before the first
};

}  // namespace monarch_flight
