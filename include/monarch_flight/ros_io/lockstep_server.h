#pragma once
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>

#include "monarch_flight/ros_io/lockstep.h"

namespace monarch_flight {

/// The participant's end: answers the coordinator's requests with an in-process Participant.
///  - The coordinator's hello comes first; its run number is the only one answered afterwards.
///  - The request answered last is answered again from the cache, without computing.
///  - Older requests (late), other runs (foreign), malformed messages and messages without the seal
///    of the run's token (forged) are counted and ignored.
class LockstepServer {
 public:
  /// `participant` and `stop` must outlive this. `stop` ends every wait, that for requests after
  /// limits.grace_s.
  LockstepServer(const ros::NodeHandle& node, const LockstepIdentity& identity,
                 Participant& participant, const LockstepLimits& limits, const StopFlag& stop);

  /// Serves one run, until the coordinator has ended it (ABORT) and left. Throws ExchangeError: no
  /// coordinator within connect_s, disagreement in the handshake, coordinator lost or silent for
  /// silence_s, interrupted; as EarlyEnd, where the coordinator has ended before the handshake.
  void serve();

  const IgnoredMessages& counters() const { return counters_; }

 private:
  void onHello(const HelloConstPtr& hello);
  void onRequest(const ParticipantRequestConstPtr& request);
  void waitForCoordinator();
  void seekHello();
  void seekRequests();
  void seekCoordinator();
  void letCoordinatorLeave();
  bool graceIsOver();
  [[noreturn]] void refuse();
  Reply answer(const Request& request);
  void compute(const ParticipantRequest& request);
  void keep(const ParticipantRequest& request);
  void reply(ParticipantReply& message);
  bool coordinatorListens() const;

  LockstepIdentity identity_;
  Participant& participant_;
  LockstepLimits limits_;
  const StopFlag& stop_;
  IgnoredMessages counters_;
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
  ros::SteadyTime last_heard_, stopped_;
  Renewal renewal_;
  ParticipantReply cache_;    // the last good answer, when started_
  ParticipantReply failure_;  // the last failure; error is empty while there is none
  ParticipantReply kept_;     // the last good answer to CHECKPOINT, which may come within a step
};

}  // namespace monarch_flight
