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
  /// Goes on behind the messages that the bag held at a checkpoint: they are copied into a new bag,
  /// which then takes the place of the old one.
  BagOutput(const std::string& path, StateVisitor& resumed);
  ~BagOutput() override;
  void open(const std::vector<StampedMessage>& topics) override;
  void write(const StampedMessage& message) override;
  /// Begins the bag anew.
  void restart() override;
  /// Everything written so far is on the disk.
  void onCheckpoint(StateVisitor& state) override;
  bool resumed() const override { return resumed_ > 0; }
  /// Closes and gives the bag its name.
  void close() override;

 private:
  void giveUp();
  void create();
  void takeOver();
  void sync();
  template <class Message>
  void put(const std::string& topic, const ros::Time& stamp, const Message& content, bool latched);

  std::string path_;
  std::uint64_t messages_ = 0;        // written
  std::uint64_t resumed_ = 0;         // of them before the resumption
  std::unique_ptr<rosbag::Bag> bag_;  // none before open() and after a failure
};

}  // namespace monarch_flight
