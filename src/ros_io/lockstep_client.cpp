#include "monarch_flight/ros_io/lockstep_client.h"

#include <algorithm>
#include <optional>

#include "monarch_flight/ros_io/conversions.h"
#include "monarch_flight/ros_io/early_end.h"

namespace monarch_flight {
namespace {

// Longest uninterrupted wait: an interrupt is noticed within it. Messages and lost connections end
// it.
const ros::WallDuration kSlice(0.1);
// ABORT is a courtesy: a node that computes, hangs or is gone is not waited for any longer.
constexpr double kAbortLimit = 2.0;
const ros::WallDuration kGreetings(0.2);  // between two signs of life

/// What a solver does once and takes the longer the larger the flow is. All others wait meanwhile.
bool growsWithTheFlow(Phase phase) {
  return phase == Phase::kStart || phase == Phase::kCheckpoint || phase == Phase::kRestore;
}

ros::WallDuration slice(const ros::SteadyTime& deadline) {
  const ros::WallDuration left = deadline - ros::SteadyTime::now();
  return std::max(ros::WallDuration(0.0), std::min(left, kSlice));
}

}  // namespace

RosParticipant::RosParticipant(const ros::NodeHandle& node, const LockstepIdentity& identity,
                               LockstepRun& run)
    : identity_(identity),
      run_(run),
      node_(node, roleName(identity.role)),
      hello_out_(node_, "coordinator_hello", true, run.queue, identity.token),
      requests_(node_, "request", false, run.queue, identity.token) {
  seekHello();
  seekReplies();
  run_.participants.push_back(this);
}

RosParticipant::~RosParticipant() {
  auto& all = run_.participants;
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
}

void RosParticipant::seekHello() {
  hello_in_.shutdown();
  hello_in_ = subscribeOn(run_.queue, node_, "hello", identity_.token, counters_,
                          &RosParticipant::onHello, this);
}

void RosParticipant::seekReplies() {
  replies_.shutdown();
  replies_ = subscribeOn(run_.queue, node_, "reply", identity_.token, counters_,
                         &RosParticipant::onReply, this);
}

std::string RosParticipant::name() const {
  return std::string("the ") + roleName(identity_.role) + " node" +
         (answer_ ? " (" + answer_->node + ")" : "");
}

bool RosParticipant::connected() const { return answer_ && requests_.heardBy(answer_->node); }

bool RosParticipant::ready() const { return connected() && replies_.getNumPublishers() > 0; }

void RosParticipant::connect() {
  greet();
  const ros::SteadyTime deadline =
      ros::SteadyTime::now() + ros::WallDuration(run_.limits.connect_s);
  Renewal renewal;
  EarlyEnd end(ros::names::parentNamespace(node_.getNamespace()), roleName(role()), name());
  while (!ready()) {
    end.refuse();
    if (renewal.due()) {
      if (!answer_) seekHello();
      if (replies_.getNumPublishers() == 0) seekReplies();
    }
    run_.queue.callAvailable(slice(deadline));
    if (answer_ && !answer_->refusal.empty()) {
      throw ExchangeError(name() + " refuses the run: " + answer_->refusal);
    }
    if (answer_) {
      const std::string why = disagreement(identity_, *answer_);
      if (!why.empty()) throw ExchangeError("cannot run with " + name() + ": " + why);
    }
    if (*run_.stop || !ros::ok()) throw ExchangeError("interrupted while waiting for " + name());
    if (ros::SteadyTime::now() >= deadline) {
      throw ExchangeError(
          name() + " did not answer the handshake within " + inSeconds(run_.limits.connect_s) +
          (role() == Role::kFluidLeft ? ": is it launched (wings:=independent) and" : ": is it") +
          " running, in namespace " + node_.getNamespace() + " of this master" +
          (counters_.forged > 0 ? ", with the same token (" + std::to_string(counters_.forged) +
                                      " messages had another seal)?"
                                : "?"));
    }
  }
}

void RosParticipant::requireAlive(const ExchangeKey& key) const {
  const std::string where = " while waiting for " + name() + " at " + describe(key);
  if (key.phase != Phase::kAbort && !ros::ok()) throw ExchangeError("interrupted" + where);
  if (!connected()) {
    throw ExchangeError(name() + " is lost (connection closed) at " + describe(key));
  }
  if (key.phase == Phase::kAbort) return;
  requireEveryone(where);
}

void RosParticipant::requireEveryone(const std::string& where) const {
  for (const RosParticipant* one : run_.participants) {
    if (!one->connected())
      throw ExchangeError(one->name() + " is lost (connection closed)" + where);
  }
}

void RosParticipant::greet() const {
  Hello hello = makeHello(identity_, run_.id);
  hello_out_.publish(hello);
}

void RosParticipant::greetEveryone() const {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (now < run_.greeted + kGreetings) return;
  for (const RosParticipant* one : run_.participants) one->greet();
  run_.greeted = now;
}

IgnoredMessages RosParticipant::ignored() const {
  IgnoredMessages all = counters_;
  all += counters_there_;
  return all;
}

double RosParticipant::limitOf(Phase phase) const {
  if (growsWithTheFlow(phase)) return run_.limits.start_s;
  if (phase == Phase::kAbort) return std::min(kAbortLimit, run_.limits.exchange_s);
  return run_.limits.exchange_s;
}

Reply RosParticipant::exchange(const Request& request) {
  ask(request);
  return answer();
}

void RosParticipant::ask(const Request& request) {
  pending_ = toMessage(request);
  if (request.key.phase == Phase::kStart) pending_.checkpoints = run_.checkpoints;
  reply_.reset();
  run_.queue.callAvailable();  // takes note of nodes that have gone since the last exchange
  requireAlive(request.key);
  asked_ = ros::SteadyTime::now();
  requests_.publish(pending_);
}

Reply RosParticipant::answer() {
  await(asked_);
  counters_there_ = fromMessage(reply_->ignored);
  Reply reply = fromMessage(*reply_);
  if (!reply.error.empty() && reply.error.find("step ") == std::string::npos)
    reply.error = name() + ", " + describe(reply.key) + ": " + reply.error;
  if (reply.error.empty() && !(finite(reply.interface) && reply.loads.finite())) {
    reply.error = name() + " answered a number that is not finite at " + describe(reply.key);
  }
  return reply;
}

void RosParticipant::await(const ros::SteadyTime& begin) {
  const ExchangeKey key = fromMessage(pending_.key);
  const double limit = limitOf(key.phase);
  const ros::SteadyTime deadline = begin + ros::WallDuration(limit);
  ros::WallDuration patience(limit / 8.0);  // then it is asked again: after 1/8, 1/4, 1/2
  std::optional<ros::SteadyTime> stopped;   // when the interrupt was seen
  while (!reply_) {
    run_.queue.callAvailable(slice(deadline));
    if (reply_) return;
    requireAlive(key);
    const ros::SteadyTime now = ros::SteadyTime::now();
    if (growsWithTheFlow(key.phase) && key.phase != Phase::kStart) greetEveryone();
    if (*run_.stop && !stopped) stopped = now;
    if (stopped && now >= *stopped + ros::WallDuration(run_.limits.grace_s)) {
      throw ExchangeError("interrupted while waiting for " + name() + " at " + describe(key));
    }
    if (now >= deadline) {
      throw ExchangeError(name() + " did not answer " + describe(key) + " within " +
                          inSeconds(limit) +
                          " (watchdog); messages ignored so far: " + counters_.describe());
    }
    if (now >= begin + patience) {
      requests_.publish(pending_);
      patience += patience;
    }
  }
}

void RosParticipant::onHello(const HelloConstPtr& hello) {
  if (hello->run != run_.id) {
    ++counters_.foreign;
  } else if (answer_) {
    ++counters_.repeated;
  } else {
    answer_ = hello;
  }
}

void RosParticipant::onReply(const ParticipantReplyConstPtr& reply) {
  if (!problem(*reply).empty()) {
    ++counters_.malformed;
  } else if (reply->key.run != run_.id) {
    ++counters_.foreign;
  } else if (fromMessage(reply->key) != fromMessage(pending_.key)) {
    ++counters_.late;
  } else if (reply_) {
    ++counters_.repeated;
  } else {
    reply_ = reply;
  }
}

}  // namespace monarch_flight
