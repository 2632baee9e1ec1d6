#pragma once
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>

#include <memory>
#include <vector>

#include "monarch_flight/ros_io/lockstep.h"

namespace monarch_flight {

class RosParticipant;

/// What the coordinator's connections of one run have in common.
struct LockstepRun {
  ros::CallbackQueue queue;  ///< of all connections: whoever waits also sees the others get lost
  std::uint64_t id = 0;
  std::string checkpoints;  ///< their folder, which START tells
  LockstepLimits limits;
  const StopFlag* stop = nullptr;                   ///< ends every wait when it becomes true
  std::vector<const RosParticipant*> participants;  ///< as long as they live
  ros::SteadyTime greeted;                          ///< when all of them had the last sign of life
};

/// The coordinator's end: a solver in another node, as a Participant (fields: msg/*.msg).
/// Topics `<role>/coordinator_hello` and `<role>/request` out, `<role>/hello` and `<role>/reply`
/// in.
class RosParticipant : public Participant {
 public:
  /// Advertises and subscribes in `node`'s namespace. `run` must outlive this.
  RosParticipant(const ros::NodeHandle& node, const LockstepIdentity& identity, LockstepRun& run);
  ~RosParticipant() override;
  RosParticipant(const RosParticipant&) = delete;
  RosParticipant& operator=(const RosParticipant&) = delete;

  /// Handshake; returns when both directions are connected and the participant has agreed. Throws
  /// ExchangeError naming the node and the reason: refusal, disagreement or no answer in connect_s.
  void connect();
  /// Precondition: connect() returned. Asks again after an eighth, a quarter and half of the limit.
  /// Throws ExchangeError naming participant, step, sub-iteration and phase: no reply in time, a
  /// node of the run lost, interrupted.
  Reply exchange(const Request& request) override;
  void ask(const Request& request) override;
  Reply answer() override;
  /// False before the handshake, and again once the node of this participant has gone.
  bool connected() const;
  /// "the fluid node (/monarch_flight/fluid)"
  std::string name() const;
  Role role() const { return identity_.role; }

  /// A sign of life to all solvers, at most five times a second, while nothing is asked of them (a
  /// held run, a long answer of another one): their limit of silence begins anew.
  void greetEveryone() const;
  /// Throws ExchangeError when this node or another one of the run is lost; `where` ends the text.
  void requireEveryone(const std::string& where) const;

  /// What this end has ignored.
  const IgnoredMessages& counters() const { return counters_; }
  IgnoredMessages ignored() const override;

 private:
  void greet() const;
  void seekHello();
  void seekReplies();
  void onHello(const HelloConstPtr& hello);
  void onReply(const ParticipantReplyConstPtr& reply);
  void requireAlive(const ExchangeKey& key) const;
  void await(const ros::SteadyTime& begin);
  double limitOf(Phase phase) const;
  bool ready() const;

  LockstepIdentity identity_;
  LockstepRun& run_;
  IgnoredMessages counters_, counters_there_;  // of this end, and of the other by its last reply
  ros::NodeHandle node_;
  WatchedPublisher<Hello> hello_out_;
  WatchedPublisher<ParticipantRequest> requests_;
  ros::Subscriber hello_in_, replies_;
  HelloConstPtr answer_;        // of this run
  ParticipantRequest pending_;  // what is, or was last, waited for
  ros::SteadyTime asked_;
  ParticipantReplyConstPtr reply_;  // to pending_
};

}  // namespace monarch_flight
