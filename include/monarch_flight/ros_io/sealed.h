#pragma once
#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace monarch_flight {

/// A message as it came over the wire. Subscribing for it instead of the message itself puts the
/// check of the seal before the parser: bytes of strangers are never interpreted, so no length in
/// them can claim memory.
template <class Message>
struct Sealed {
  std::vector<std::uint8_t> bytes;
};

}  // namespace monarch_flight

namespace ros {
namespace message_traits {

template <class Message>
struct MD5Sum<monarch_flight::Sealed<Message>> {
  static const char* value() { return MD5Sum<Message>::value(); }
  static const char* value(const monarch_flight::Sealed<Message>&) { return value(); }
};
template <class Message>
struct DataType<monarch_flight::Sealed<Message>> {
  static const char* value() { return DataType<Message>::value(); }
  static const char* value(const monarch_flight::Sealed<Message>&) { return value(); }
};
template <class Message>
struct Definition<monarch_flight::Sealed<Message>> {
  static const char* value() { return Definition<Message>::value(); }
  static const char* value(const monarch_flight::Sealed<Message>&) { return value(); }
};

}  // namespace message_traits
namespace serialization {

template <class Message>
struct Serializer<monarch_flight::Sealed<Message>> {
  template <class Stream>
  static void read(Stream& stream, monarch_flight::Sealed<Message>& m) {
    m.bytes.resize(stream.getLength());
    if (!m.bytes.empty()) {
      std::memcpy(m.bytes.data(), stream.advance(stream.getLength()), m.bytes.size());
    }
  }
  template <class Stream>
  static void write(Stream& stream, const monarch_flight::Sealed<Message>& m) {
    if (!m.bytes.empty()) {
      std::memcpy(stream.advance(static_cast<std::uint32_t>(m.bytes.size())), m.bytes.data(),
                  m.bytes.size());
    }
  }
  static std::uint32_t serializedLength(const monarch_flight::Sealed<Message>& m) {
    return static_cast<std::uint32_t>(m.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros
