#pragma once
#include <monarch_flight/Hello.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <cstdint>
#include <set>
#include <string>

#include "monarch_flight/coupling/participant.h"
#include "monarch_flight/coupling/stop_flag.h"
#include "monarch_flight/ros_io/sealed.h"
#include "monarch_flight/ros_io/token.h"

namespace monarch_flight {

/// What both ends of a lockstep connection must agree on.
struct LockstepIdentity {
  Role role = Role::kFluid;  ///< of the solver at the participant's end
  std::string case_name;     ///< for messages
  std::string case_sha256;   ///< of the resolved case, hex
  Token token;               ///< of the run
};

/// Wall-clock limits [s]; every wait of the protocol ends by one of them.
struct LockstepLimits {
  double connect_s = 60.0;   ///< handshake: both directions connected and agreed
  double exchange_s = 60.0;  ///< one request until its reply (the watchdog)
  double start_s = 600.0;    ///< the same for START, CHECKPOINT and RESTORE: of the whole flow
  double silence_s = 180.0;  ///< participant: between two requests
  /// How long both ends go on after an interrupt, so that a last checkpoint can be made; roslaunch
  /// interrupts all nodes at once and waits 15 s for them.
  double grace_s = 10.0;
};

/// Limits that follow from the watchdog of a case: START, CHECKPOINT and RESTORE may take ten times
/// as long as an exchange; a participant bears the silence of two exchanges (START: two STARTs) with
/// the other two and one more.
LockstepLimits limitsFor(double watchdog_s);

/// Depth of the queues of the protocol: few messages are ever sent, many may arrive from strangers.
/// Nothing is lost while at most this many wait.
constexpr std::uint32_t kOutgoing = 8, kIncoming = 1000;

/// A subscriber asks a publisher once for a connection; roscpp does not ask again where that fails,
/// as it may on a machine under load. So what is missing after this time is subscribed to anew, and
/// again after twice the time, and so on: a slow connection is not cut for ever.
const ros::WallDuration kRenewal(3.0);

/// Says when to subscribe anew.
class Renewal {
 public:
  bool due() {
    const ros::SteadyTime now = ros::SteadyTime::now();
    if (now < next_) return false;
    interval_ += interval_;
    next_ = now + interval_;
    return true;
  }

 private:
  ros::WallDuration interval_ = kRenewal;
  ros::SteadyTime next_ = ros::SteadyTime::now() + kRenewal;
};

/// "12.5 s", for messages.
std::string inSeconds(double s);

/// Hello of this node; `run` is 0 only before the coordinator's number is known.
Hello makeHello(const LockstepIdentity& identity, std::uint64_t run,
                const std::string& refusal = "");
/// Why `other` does not fit (protocol, role, case), naming both values; empty when it fits.
std::string disagreement(const LockstepIdentity& own, const Hello& other);

/// A publisher that seals what it sends and knows by name who listens: a killed listener is noticed
/// at once, whoever else (a recorder, rostopic) listens too. Callbacks run on `queue`.
template <class Message>
class WatchedPublisher {
 public:
  WatchedPublisher(ros::NodeHandle& node, const std::string& topic, bool latch,
                   ros::CallbackQueue& queue, const Token& token)
      : topic_(node.resolveName(topic)), token_(token) {
    const auto joined = [this](const ros::SingleSubscriberPublisher& s) {
      listeners_.insert(s.getSubscriberName());
    };
    const auto left = [this](const ros::SingleSubscriberPublisher& s) {
      const auto found = listeners_.find(s.getSubscriberName());
      if (found != listeners_.end()) listeners_.erase(found);
    };
    auto options = ros::AdvertiseOptions::create<Message>(topic, kOutgoing, joined, left,
                                                          ros::VoidConstPtr(), &queue);
    options.latch = latch;
    publisher_ = node.advertise(options);
  }
  void publish(Message& message) const {
    token_.seal(topic_, message);
    publisher_.publish(message);
  }
  bool heardBy(const std::string& node) const { return listeners_.count(node) > 0; }

 private:
  std::string topic_;
  Token token_;
  std::multiset<std::string> listeners_;
  ros::Publisher publisher_;
};

/// Null where the bytes are not such a message.
template <class Message>
boost::shared_ptr<Message> parsed(const std::vector<std::uint8_t>& bytes) {
  auto message = boost::make_shared<Message>();
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  try {
    ros::serialization::deserialize(stream, *message);
  } catch (const ros::serialization::StreamOverrunException&) {
    return nullptr;
  }
  return message;
}

/// Subscribes on `queue` without Nagle's delay. The callback hears what carries the token's seal;
/// the rest is counted: `ignored` must outlive the subscriber.
template <class Message, class Object>
ros::Subscriber subscribeOn(ros::CallbackQueue& queue, ros::NodeHandle& node,
                            const std::string& topic, const Token& token, IgnoredMessages& ignored,
                            void (Object::*callback)(const boost::shared_ptr<Message const>&),
                            Object* object) {
  ros::SubscribeOptions options;
  options.template init<Sealed<Message>>(
      topic, kIncoming,
      [full = node.resolveName(topic), token, &ignored, object,
       callback](const boost::shared_ptr<Sealed<Message> const>& sealed) {
        if (!token.sealed(full, sealed->bytes)) {
          ++ignored.forged;
        } else if (const auto message = parsed<Message>(sealed->bytes)) {
          (object->*callback)(message);
        } else {
          ++ignored.malformed;
        }
      });
  options.callback_queue = &queue;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node.subscribe(options);
}

}  // namespace monarch_flight
