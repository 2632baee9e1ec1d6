#pragma once
#include <monarch_flight/Hello.h>
#include <monarch_flight/ParticipantReply.h>
#include <monarch_flight/ParticipantRequest.h>
#include <ros/ros.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "monarch_flight/ros_io/lockstep.h"

namespace monarch_flight {

/// What an attacker has sent, by what must become of it.
struct Sent {
  std::uint64_t forged = 0, foreign = 0, malformed = 0;
  std::uint64_t replayed = 0;  ///< true messages again, in any order: late or repeated
  std::uint64_t early = 0;     ///< requests of steps far ahead: refused, their answer is late
  std::uint64_t all() const { return forged + foreign + malformed + replayed + early; }
};

/// Overhears one topic of the protocol and speaks there: without the token (forged: mutilated,
/// altered, with numbers that are not finite, huge, or freely invented) and as a confused node that
/// has it (of another run, malformed, old messages again, steps far ahead).
template <class Message>
class Attacker {
 public:
  Attacker(ros::NodeHandle& node, const std::string& topic, const Token& token, unsigned seed)
      : topic_(topic),
        token_(token),
        random_(seed),
        node_(node),
        publisher_(node.advertise<Sealed<Message>>(topic, 0)) {
    listen();
  }

  const std::string& topic() const { return topic_; }
  bool ready() const { return publisher_.getNumSubscribers() >= 2 && !heard_.empty(); }
  /// Anew: roscpp does not try again where a node could not be reached once.
  void listen() {
    subscriber_.shutdown();
    subscriber_ = node_.subscribe(topic_, 0, &Attacker::overhear, this);
  }

  /// Sends one message of a random kind.
  void send(Sent& sent) {
    Message message = heard_[random_() % heard_.size()];
    const unsigned kind = static_cast<unsigned>(random_() % 10);
    if (kind < 2) return sendReplay(message, sent);
    if (kind == 2) return sendForeign(message, sent);
    if (kind == 3) return sendMalformed(message, sent);
    ++sent.forged;
    if (kind == 4) return publish(mutilated(bytesOf(message)));
    if (kind == 5) message = Message();
    if (kind < 8) {
      spoil(message, kind == 6 ? std::numeric_limits<double>::quiet_NaN() : 1e300);
    } else {
      inflate(message);
    }
    publish(bytesOf(message));
  }

 private:
  using Bytes = std::vector<std::uint8_t>;

  void overhear(const ros::MessageEvent<Sealed<Message> const>& event) {
    if (event.getPublisherName() == ros::this_node::getName()) return;
    const auto message = parsed<Message>(event.getMessage()->bytes);
    if (heard_.size() < 50) {
      heard_.push_back(*message);
    } else {
      heard_[heard_count_++ % 50] = *message;
    }
  }
  void publish(const Bytes& bytes) { publisher_.publish(Sealed<Message>{bytes}); }
  static Bytes bytesOf(const Message& message) {
    Bytes bytes(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, message);
    return bytes;
  }
  void publishSealed(Message& message) {
    token_.seal(topic_, message);
    publish(bytesOf(message));
  }
  // Cut, or with bits flipped anywhere: lengths, keys, numbers, seal.
  Bytes mutilated(Bytes bytes) {
    if (random_() % 2 == 0) {
      bytes.resize(random_() % bytes.size());
    } else {
      for (int i = 0; i < 5; ++i) bytes[random_() % bytes.size()] ^= 1u << random_() % 8;
      bytes.back() ^= 1;  // flips of the same bit may have cancelled each other
    }
    return bytes;
  }

  void sendReplay(const Message& message, Sent& sent);
  void sendForeign(Message& message, Sent& sent);
  void sendMalformed(Message& message, Sent& sent);
  static void spoil(Message& message, double value);
  static void inflate(Message& message);

  std::string topic_;
  Token token_;
  std::mt19937 random_;
  ros::NodeHandle node_;
  std::vector<Message> heard_;  // the last ones
  std::size_t heard_count_ = 0;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

template <class Message>
void Attacker<Message>::sendReplay(const Message& message, Sent& sent) {
  ++sent.replayed;
  publish(bytesOf(message));
}
// A greeting again is a sign of life at the solvers and repeated at the coordinator: not told apart
// here.
template <>
inline void Attacker<Hello>::sendReplay(const Hello& message, Sent& sent) {
  Hello other = message;
  other.case_name += "?";
  ++sent.forged;
  publish(bytesOf(other));
}

template <class Message>
void Attacker<Message>::sendForeign(Message& message, Sent& sent) {
  ++sent.foreign;
  message.key.run += 1 + random_() % 1000;
  publishSealed(message);
}
template <>
inline void Attacker<Hello>::sendForeign(Hello& message, Sent& sent) {
  ++sent.foreign;
  message.run += 1 + random_() % 1000;
  publishSealed(message);
}

template <>
inline void Attacker<Hello>::sendMalformed(Hello& message, Sent& sent) {
  sendForeign(message, sent);
}
template <>
inline void Attacker<ParticipantRequest>::sendMalformed(ParticipantRequest& message, Sent& sent) {
  switch (random_() % 3) {
    case 0:
      message.protocol += 1 + static_cast<std::uint32_t>(random_() % 9);
      break;
    case 1:
      message.key.phase = static_cast<std::uint8_t>(100 + random_() % 100);
      break;
    default:
      message.key.step += 1000000000u;
      message.key.phase = CouplingKey::ITERATE;
      ++sent.early;
      return publishSealed(message);
  }
  ++sent.malformed;
  publishSealed(message);
}
template <>
inline void Attacker<ParticipantReply>::sendMalformed(ParticipantReply& message, Sent& sent) {
  ++sent.malformed;
  message.load_operator.resize(2 + random_() % 70);
  publishSealed(message);
}

template <class Message>
void Attacker<Message>::spoil(Message& message, double value) {
  geometry_msgs::Point& position = message.interface.body.position;
  position.x = position.y = position.z = value;
  message.interface.theta_right.position = -value;
}
template <>
inline void Attacker<Hello>::spoil(Hello& message, double) {
  message.case_sha256 = "../../../../etc/passwd";
}

template <class Message>
void Attacker<Message>::inflate(Message& message) {
  message.interface.body.velocity.x = std::numeric_limits<double>::max();
}
template <>
inline void Attacker<Hello>::inflate(Hello& message) {
  message.refusal.assign(200000, 'x');
}
template <>
inline void Attacker<ParticipantReply>::inflate(ParticipantReply& message) {
  message.surface.resize(10000);
}

}  // namespace monarch_flight
