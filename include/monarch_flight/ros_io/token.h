#pragma once
#include <ros/serialization.h>

#include <cstdint>
#include <string>
#include <vector>

namespace monarch_flight {

/// The secret that the nodes of one run share. Every message of the lockstep protocol ends with a
/// seal made with it: a node that does not know the token cannot speak in the run, whatever it has
/// overheard. An empty token seals nothing that a stranger could not seal, too.
class Token {
 public:
  explicit Token(std::string secret = "") : secret_(std::move(secret)) {}

  bool empty() const { return secret_.empty(); }

  /// Sets `message.seal` (its last field): HMAC-SHA256, keyed with the token, of the topic's full
  /// name, a zero byte and the serialized message without its seal.
  template <class Message>
  void seal(const std::string& topic, Message& message) const {
    std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, message);
    seal(topic, bytes, message.seal.data());
  }
  /// Whether a serialized message ends with the seal of this token and topic.
  bool sealed(const std::string& topic, const std::vector<std::uint8_t>& bytes) const;

 private:
  void seal(const std::string& topic, const std::vector<std::uint8_t>& bytes,
            std::uint8_t* out) const;

  std::string secret_;
};

}  // namespace monarch_flight
