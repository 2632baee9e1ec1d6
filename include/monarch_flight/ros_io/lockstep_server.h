#pragma once
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>

#include "monarch_flight/ros_io/lockstep.h"

namespace monarch_flight {

/// The participant's end: answers the coordinator's requests with an in-process Participant.
///  - The coordinator's hello comes first; its run number is the only one answered afterwards.
///  - The request answered last is answered again from the cache, without computing.
///  - Older requests (late), other runs (foreign) and malformed messages are counted and ignored.
class LockstepServer {
 public:
  /// `participant` and `stop` must outlive this. `stop` ends every wait, that for requests after
  /// limits.grace_s.
  LockstepServer(const ros::NodeHandle& node, const LockstepIdentity& identity,
                 Participant& participant, const LockstepLimits& limits, const StopFlag& stop);

  /// Serves one run, until the coordinator has ended it (ABORT) and left. Throws ExchangeError: no
  /// coordinator within connect_s, disagreement in the handshake, coordinator lost or silent for
  /// silence_s, interrupted.
  void serve();

  const LockstepCounters& counters() const { return counters_; }

 private:
  void onHello(const HelloConstPtr& hello);
  void onRequest(const ParticipantRequestConstPtr& request);
  void waitForCoordinator();
  void letCoordinatorLeave();
  bool graceIsOver();
  [[noreturn]] void refuse();
  Reply answer(const Request& request);
  bool coordinatorListens() const;

  LockstepIdentity identity_;
  Participant& participant_;
  LockstepLimits limits_;
  const StopFlag& stop_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  WatchedPublisher<Hello> hello_out_;
  WatchedPublisher<ParticipantReply> replies_;
  ros::Subscriber hello_in_, requests_;
  HelloConstPtr coordinator_;  // the newest before the first request, then fixed
  std::string refusal_;        // why this node does not fly with coordinator_; empty: it does
  bool started_ = false;       // START has been answered
  bool iterating_ = false;     // START of all participants is over
  bool ended_ = false;         // the coordinator has ended the run
  ros::WallTime last_heard_, stopped_;
  ParticipantReply cache_;  // answer to the last request, when started_
  LockstepCounters counters_;
};

}  // namespace monarch_flight
