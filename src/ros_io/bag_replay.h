#pragma once
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <functional>
#include <string>

namespace monarch_flight {

/// A message as it lies in a bag.
struct RecordedMessage {
  std::string topic;
  ros::Time stamp;
  bool latched = false;
  topic_tools::ShapeShifter content;
};

/// Reads the first `count` messages of a bag in the order in which they were written, whether or
/// not the bag was ever closed: a recorder that was killed leaves whole chunks without an index,
/// which rosbag itself does not open. Format: http://wiki.ros.org/Bags/Format/2.0. Throws
/// std::runtime_error naming the file when it holds fewer.
void replayBag(const std::string& path, std::uint64_t count,
               const std::function<void(const RecordedMessage&)>& take);

}  // namespace monarch_flight
