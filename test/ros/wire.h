#pragma once
#include <ros/serialization.h>

namespace monarch_flight {

/// Through the bytes of the wire.
template <class Message>
Message overTheWire(const Message& message) {
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(message);
  Message out;
  ros::serialization::deserializeMessage(bytes, out);
  return out;
}

}  // namespace monarch_flight
