#include "monarch_flight/ros_io/lockstep_server.h"

#include <algorithm>
#include <tuple>

#include "monarch_flight/ros_io/conversions.h"
#include "monarch_flight/ros_io/early_end.h"

namespace monarch_flight {
namespace {

// Longest uninterrupted wait: an interrupt or a deadline is noticed within it.
const ros::WallDuration kListening(0.1);

// Requests of a run come in this order.
std::tuple<std::uint32_t, std::uint32_t, std::uint8_t, std::uint32_t> order(
    const CouplingKey& key) {
  return std::make_tuple(key.reset, key.step, key.phase, key.iteration);
}

}  // namespace

LockstepServer::LockstepServer(const ros::NodeHandle& node, const LockstepIdentity& identity,
                               Participant& participant, const LockstepLimits& limits,
                               const StopFlag& stop)
    : identity_(identity),
      participant_(participant),
      limits_(limits),
      stop_(stop),
      node_(node, roleName(identity.role)),
      hello_out_(node_, "hello", true, queue_, identity.token),
      replies_(node_, "reply", false, queue_, identity.token) {
  seekHello();
  seekRequests();
}

void LockstepServer::seekHello() {
  hello_in_.shutdown();
  hello_in_ = subscribeOn(queue_, node_, "coordinator_hello", identity_.token, counters_,
                          &LockstepServer::onHello, this);
}

void LockstepServer::seekRequests() {
  requests_.shutdown();
  requests_ = subscribeOn(queue_, node_, "request", identity_.token, counters_,
                          &LockstepServer::onRequest, this);
}

/// Before the first request: subscribes anew to what is still missing.
void LockstepServer::seekCoordinator() {
  if (started_ || !renewal_.due()) return;
  if (!coordinator_) seekHello();
  if (requests_.getNumPublishers() == 0) seekRequests();
}

bool LockstepServer::coordinatorListens() const {
  return coordinator_ && replies_.heardBy(coordinator_->node);
}

void LockstepServer::serve() {
  waitForCoordinator();
  if (!refusal_.empty()) refuse();
  last_heard_ = ros::SteadyTime::now();
  while (!ended_) {
    queue_.callAvailable(kListening);
    if (ended_) break;
    seekCoordinator();
    if (!ros::ok() || graceIsOver()) throw ExchangeError("interrupted");
    if (!coordinatorListens()) {
      throw ExchangeError("the coordinator (" + coordinator_->node +
                          ") is lost: its connection closed");
    }
    const double limit = iterating_ ? limits_.silence_s : limits_.silence_s + 2.0 * limits_.start_s;
    if (ros::SteadyTime::now() > last_heard_ + ros::WallDuration(limit)) {
      throw ExchangeError("the coordinator (" + coordinator_->node + ") has been silent for " +
                          inSeconds(limit));
    }
  }
  letCoordinatorLeave();
}

/// An interrupted run ends when the coordinator, interrupted too, has made its last checkpoint.
bool LockstepServer::graceIsOver() {
  if (!stop_) return false;
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (stopped_.isZero()) stopped_ = now;
  return now >= stopped_ + ros::WallDuration(limits_.grace_s);
}

void LockstepServer::letCoordinatorLeave() {
  // The launcher ends everything with the first node that goes; the coordinator still closes its
  // files.
  const ros::SteadyTime deadline = ros::SteadyTime::now() + ros::WallDuration(limits_.exchange_s);
  while (coordinatorListens() && !graceIsOver() && ros::ok() && ros::SteadyTime::now() < deadline) {
    queue_.callAvailable(kListening);
  }
}

void LockstepServer::waitForCoordinator() {
  const ros::SteadyTime deadline = ros::SteadyTime::now() + ros::WallDuration(limits_.connect_s);
  renewal_ = Renewal();
  EarlyEnd coordinator(ros::names::parentNamespace(node_.getNamespace()), "coordinator",
                       "the coordinator");
  while (!coordinatorListens()) {
    coordinator.refuse();
    queue_.callAvailable(kListening);
    seekCoordinator();
    if (!refusal_.empty()) refuse();
    if (stop_ || !ros::ok()) throw ExchangeError("interrupted while waiting for the coordinator");
    if (ros::SteadyTime::now() > deadline) {
      throw ExchangeError("no coordinator appeared within " + inSeconds(limits_.connect_s) +
                          ": is it running, in the same namespace of this master, with the same "
                          "token? (" +
                          std::to_string(counters_.forged) + " messages had another seal)");
    }
  }
}

void LockstepServer::onHello(const HelloConstPtr& hello) {
  if (started_) {
    if (hello->run == coordinator_->run) {
      last_heard_ = ros::SteadyTime::now();  // a paused run
    } else {
      ++counters_.foreign;
    }
    return;
  }
  coordinator_ = hello;
  refusal_ = disagreement(identity_, *hello);
  Hello answer = makeHello(identity_, hello->run, refusal_);
  hello_out_.publish(answer);
}

void LockstepServer::refuse() {
  // The latched refusal is delivered to whoever connects; leave once the coordinator has had it.
  const ros::SteadyTime deadline = ros::SteadyTime::now() + ros::WallDuration(2.0);
  while (!hello_out_.heardBy(coordinator_->node) && ros::SteadyTime::now() < deadline && !stop_) {
    queue_.callAvailable(ros::WallDuration(0.05));
  }
  ros::WallDuration(0.3).sleep();
  throw ExchangeError("handshake refused: " + refusal_);
}

Reply LockstepServer::answer(const Request& request) {
  try {
    return participant_.exchange(request);
  } catch (const std::exception& e) {
    Reply failed;
    failed.error = e.what();
    return failed;
  }
}

void LockstepServer::onRequest(const ParticipantRequestConstPtr& request) {
  const CouplingKey& key = request->key;
  if (!problem(*request).empty()) {
    ++counters_.malformed;
    return;
  }
  if (!coordinator_ || key.run != coordinator_->run) {
    ++counters_.foreign;
    return;
  }
  last_heard_ = ros::SteadyTime::now();
  if (key.phase == CouplingKey::ABORT) {
    ended_ = true;
    ParticipantReply farewell = toMessage(answer(fromMessage(*request)));
    replies_.publish(farewell);
    return;
  }
  if (key.phase == CouplingKey::CHECKPOINT) return keep(*request);
  if (started_ && order(key) < order(cache_.key)) {
    ++counters_.late;
  } else if (started_ && order(key) == order(cache_.key)) {
    ++counters_.repeated;
    reply(cache_);
  } else if (!failure_.error.empty() && order(key) == order(failure_.key)) {
    ++counters_.repeated;
    reply(failure_);
  } else {
    compute(*request);
  }
}

/// A checkpoint of the committed step may be asked for within the next one.
void LockstepServer::keep(const ParticipantRequest& request) {
  if (kept_.key.phase == CouplingKey::CHECKPOINT && order(kept_.key) == order(request.key)) {
    ++counters_.repeated;
    return reply(kept_);
  }
  ParticipantReply answered = toMessage(answer(fromMessage(request)));
  answered.key = request.key;
  last_heard_ = ros::SteadyTime::now();
  if (answered.error.empty()) kept_ = answered;
  reply(answered);
}

void LockstepServer::compute(const ParticipantRequest& request) {
  ParticipantReply answered = toMessage(answer(fromMessage(request)));
  answered.key = request.key;
  last_heard_ = ros::SteadyTime::now();
  if (!answered.error.empty()) {  // who asks out of turn does not make what is due late
    failure_ = std::move(answered);
    return reply(failure_);
  }
  cache_ = std::move(answered);
  started_ = true;
  iterating_ = iterating_ || request.key.phase != CouplingKey::START;
  reply(cache_);
}

void LockstepServer::reply(ParticipantReply& message) {
  message.ignored = toMessage(counters_);
  replies_.publish(message);
}

}  // namespace monarch_flight
