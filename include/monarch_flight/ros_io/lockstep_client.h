#pragma once
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>

#include "monarch_flight/ros_io/lockstep.h"

namespace monarch_flight {

/// The coordinator's end: a solver in another node, as a Participant (docs: msg/*.msg).
/// Topics <role>/coordinator_hello and <role>/request out, <role>/hello and <role>/reply in.
class RosParticipant : public Participant {
 public:
  /// Advertises and subscribes in `node`'s namespace. `stop` ends every wait; it must outlive this.
  RosParticipant(const ros::NodeHandle& node, const LockstepIdentity& identity, std::uint64_t run,
                 const LockstepLimits& limits, const bool& stop);

  /// Handshake; returns when both directions are connected and the participant has agreed. Throws
  /// ExchangeError naming the node and the reason: refusal, disagreement or no answer in connect_s.
  void connect();
  /// Precondition: connect() returned. Asks again once, after half the limit. Throws ExchangeError naming
  /// participant, step, sub-iteration and phase: no reply in time, node lost, interrupted.
  Reply exchange(const Request& request) override;
  /// Tells the participant that the run is over and waits for it to leave, 2 s at most. Never throws.
  void finish() noexcept;
  /// False once the node of this participant has gone.
  bool connected() const;

  const LockstepCounters& counters() const { return counters_; }

 private:
  void onHello(const HelloConstPtr& hello);
  void onReply(const ParticipantReplyConstPtr& reply);
  void requireAlive(const std::string& waiting_for) const;
  bool ready() const;
  double limitOf(Phase phase) const;
  std::string name() const;

  LockstepIdentity identity_;
  std::uint64_t run_;
  LockstepLimits limits_;
  const bool& stop_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  WatchedPublisher<Hello> hello_out_;
  WatchedPublisher<ParticipantRequest> requests_;
  ros::Subscriber hello_in_, replies_;
  HelloConstPtr answer_;             // of this run
  CouplingKey pending_;              // what is waited for
  bool waiting_ = false;
  ParticipantReplyConstPtr reply_;   // to pending_
  LockstepCounters counters_;
};

}  // namespace monarch_flight
