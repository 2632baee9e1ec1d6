#pragma once
#include <memory>

#include "monarch_flight/guidance/command_inbox.h"
#include "monarch_flight/ros_io/lockstep_client.h"

namespace monarch_flight {

/// Guidance by a node of one's own. Asked once a step, in lockstep, it answers with a command,
/// which the case's own wingbeat follows through its filters, or with joint angles and rest angle
/// of its own making (docs/guidance.md). Body, start and wind stay the case's.
class GuidanceByNode : public Participant {
 public:
  /// `own` prescribes what the node does not, and is led through `inbox`. Both ends must outlive
  /// this.
  GuidanceByNode(RosParticipant& node, Participant& own, std::shared_ptr<CommandInbox> inbox)
      : node_(node), own_(own), inbox_(std::move(inbox)) {}
  Reply exchange(const Request& request) override;
  IgnoredMessages ignored() const override { return node_.ignored(); }

 private:
  RosParticipant& node_;
  Participant& own_;
  std::shared_ptr<CommandInbox> inbox_;
};

}  // namespace monarch_flight
