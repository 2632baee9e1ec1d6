#pragma once
#include <rosbag/bag.h>

#include <memory>
#include <string>

#include "monarch_flight/ros_io/flight_messages.h"

namespace monarch_flight {

/// Writes messages into a bag, under `<path>.active` until it is closed. Every failure of the disk
/// is an OutputError naming the file; what was written before stays under the active name.
class BagOutput : public MessageOutput {
 public:
  explicit BagOutput(const std::string& path);
  ~BagOutput() override;
  void open(const std::vector<StampedMessage>& topics) override;
  void write(const StampedMessage& message) override;
  /// Begins the bag anew.
  void restart() override;
  /// Closes and gives the bag its name.
  void close() override;

 private:
  void giveUp();

  std::string path_;
  std::unique_ptr<rosbag::Bag> bag_;  // none before open() and after a failure
};

}  // namespace monarch_flight
