#pragma once
#include <ros/serialization.h>

#include <cstdint>
#include <string>
#include <vector>

namespace monarch_flight {

/// The secret that the nodes of one run share. Every message of the lockstep protocol carries a
/// seal made with it: a node that does not know the token cannot speak in the run, whatever it has
/// overheard. An empty token seals nothing that a stranger could not seal, too.
class Token {
 public:
  /// Name of the environment variable; the launch files set it to a new random text in each run.
  static constexpr char kVariable[] = "MONARCH_FLIGHT_TOKEN";

  explicit Token(std::string secret = "") : secret_(std::move(secret)) {}
  /// Empty where the variable is not set.
  static Token fromEnvironment();

  bool empty() const { return secret_.empty(); }

  /// Sets `message.seal` (its last field): HMAC-SHA256, keyed with the token, of the topic's full
  /// name, a zero byte and the serialized message without its seal.
  template <class Message>
  void seal(const std::string& topic, Message& message) const {
    const std::vector<std::uint8_t> text = sealedText(topic, message);
    code(text, message.seal.data());
  }
  /// Whether the message carries the seal of this token and topic.
  template <class Message>
  bool sealed(const std::string& topic, const Message& message) const {
    return matches(sealedText(topic, message), message.seal.data());
  }

 private:
  static constexpr std::size_t kSeal = 32;  // bytes

  template <class Message>
  static std::vector<std::uint8_t> sealedText(const std::string& topic, const Message& message) {
    const std::uint32_t size = ros::serialization::serializationLength(message);
    std::vector<std::uint8_t> text(topic.size() + 1 + size);
    std::copy(topic.begin(), topic.end(), text.begin());
    ros::serialization::OStream stream(text.data() + topic.size() + 1, size);
    ros::serialization::serialize(stream, message);
    text.resize(text.size() - kSeal);
    return text;
  }
  void code(const std::vector<std::uint8_t>& text, std::uint8_t* out) const;
  bool matches(const std::vector<std::uint8_t>& text, const std::uint8_t* seal) const;

  std::string secret_;
};

}  // namespace monarch_flight
