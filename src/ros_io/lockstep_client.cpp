#include "monarch_flight/ros_io/lockstep_client.h"

#include <algorithm>

#include "monarch_flight/ros_io/conversions.h"

namespace monarch_flight {
namespace {

// Longest uninterrupted wait: an interrupt is noticed within it. Messages and lost connections end it.
const ros::WallDuration kSlice(0.1);

std::string seconds(double s) {
  std::string text = std::to_string(s);
  return text.substr(0, text.find('.') + 2) + " s";
}

ros::WallDuration slice(const ros::WallTime& deadline) {
  const ros::WallDuration left = deadline - ros::WallTime::now();
  return std::max(ros::WallDuration(0.0), std::min(left, kSlice));
}

}  // namespace

RosParticipant::RosParticipant(const ros::NodeHandle& node, const LockstepIdentity& identity,
                               std::uint64_t run, const LockstepLimits& limits, const bool& stop)
    : identity_(identity),
      run_(run),
      limits_(limits),
      stop_(stop),
      node_(node, roleName(identity.role)),
      hello_out_(node_, "coordinator_hello", true, queue_),
      requests_(node_, "request", false, queue_),
      hello_in_(subscribeOn(queue_, node_, "hello", &RosParticipant::onHello, this)),
      replies_(subscribeOn(queue_, node_, "reply", &RosParticipant::onReply, this)) {}

std::string RosParticipant::name() const {
  return std::string("the ") + roleName(identity_.role) + " node" +
         (answer_ ? " (" + answer_->node + ")" : "");
}

bool RosParticipant::connected() const { return answer_ && requests_.heardBy(answer_->node); }

bool RosParticipant::ready() const { return connected() && replies_.getNumPublishers() > 0; }

void RosParticipant::connect() {
  hello_out_.publish(makeHello(identity_, run_));
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(limits_.connect_s);
  while (!ready()) {
    queue_.callAvailable(slice(deadline));
    if (answer_ && !answer_->refusal.empty()) {
      throw ExchangeError(name() + " refuses the run: " + answer_->refusal);
    }
    if (answer_) {
      const std::string why = disagreement(identity_, *answer_);
      if (!why.empty()) throw ExchangeError("cannot run with " + name() + ": " + why);
    }
    if (stop_ || !ros::ok()) throw ExchangeError("interrupted while waiting for " + name());
    if (ros::WallTime::now() >= deadline) {
      throw ExchangeError(name() + " did not answer the handshake within " +
                          seconds(limits_.connect_s) + ": is it running, in namespace " +
                          node_.getNamespace() + " of this master?");
    }
  }
}

void RosParticipant::requireAlive(const std::string& waiting_for) const {
  if (!connected()) throw ExchangeError(name() + " is lost (connection closed) at " + waiting_for);
  if (stop_ || !ros::ok()) {
    throw ExchangeError("interrupted while waiting for " + name() + " at " + waiting_for);
  }
}

double RosParticipant::limitOf(Phase phase) const {
  if (phase == Phase::kStart) return limits_.start_s;
  if (phase == Phase::kAbort) return std::min(2.0, limits_.exchange_s);
  return limits_.exchange_s;
}

Reply RosParticipant::exchange(const Request& request) {
  const ParticipantRequest message = toMessage(request);
  pending_ = message.key;
  reply_.reset();
  waiting_ = true;
  queue_.callAvailable();  // a node that has gone since the last exchange
  if (!connected()) requireAlive(describe(request.key));
  requests_.publish(message);
  const double limit = limitOf(request.key.phase);
  const ros::WallTime begin = ros::WallTime::now();
  const ros::WallTime deadline = begin + ros::WallDuration(limit);
  bool again = false;
  while (!reply_) {
    queue_.callAvailable(slice(deadline));
    if (reply_) break;
    if (request.key.phase != Phase::kAbort || !connected()) requireAlive(describe(request.key));
    const ros::WallTime now = ros::WallTime::now();
    if (now >= deadline) {
      throw ExchangeError(name() + " did not answer " + describe(request.key) + " within " +
                          seconds(limit) + " (watchdog); ignored messages: " +
                          counters_.describe());
    }
    if (!again && now >= begin + ros::WallDuration(0.5 * limit)) {
      requests_.publish(message);
      again = true;
    }
  }
  waiting_ = false;
  Reply reply = fromMessage(*reply_);
  if (reply.error.empty() && !(finite(reply.interface) && reply.loads.finite())) {
    reply.error = name() + " answered a number that is not finite at " + describe(reply.key);
  }
  return reply;
}

void RosParticipant::finish() noexcept {
  try {
    ParticipantRequest farewell;
    farewell.protocol = kProtocolVersion;
    farewell.key.run = run_;
    farewell.key.phase = CouplingKey::ABORT;
    waiting_ = false;
    queue_.callAvailable();
    if (!connected()) return;
    requests_.publish(farewell);
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(2.0);
    while (connected() && ros::WallTime::now() < deadline) queue_.callAvailable(slice(deadline));
  } catch (const std::exception& e) {
    ROS_WARN("%s could not be told that the run is over: %s", name().c_str(), e.what());
  }
}

void RosParticipant::onHello(const HelloConstPtr& hello) {
  if (hello->run != run_) {
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
  } else if (reply->key.run != run_) {
    ++counters_.foreign;
  } else if (fromMessage(reply->key) != fromMessage(pending_)) {
    ++counters_.late;
  } else if (!waiting_ || reply_) {
    ++counters_.repeated;
  } else {
    reply_ = reply;
  }
}

}  // namespace monarch_flight
