#include "monarch_flight/ros_io/bag_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "monarch_flight/run/output_file.h"

namespace monarch_flight {
namespace {

std::string active(const std::string& path) { return path + ".active"; }

// What rosbag play needs to publish the topic latched again.
template <class Message>
boost::shared_ptr<ros::M_string> latchedHeader() {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  (*header)["callerid"] = std::string(kNamespace) + "/coordinator";
  (*header)["latching"] = "1";
  return header;
}

}  // namespace

BagOutput::BagOutput(const std::string& path) : path_(path) {}

BagOutput::~BagOutput() {
  try {
    if (bag_) bag_->close();
  } catch (const std::exception&) {  // the bag keeps its active name, and the run has said why
    giveUp();
  }
}

// rosbag closes, and so writes, in its destructor; there a full disk would end the process. Whoever
// cannot write leaves the bag open to the end of the process.
void BagOutput::giveUp() { static_cast<void>(bag_.release()); }

void BagOutput::open(const std::vector<StampedMessage>&) {
  try {
    bag_ = std::make_unique<rosbag::Bag>();
    bag_->open(active(path_), rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::LZ4);
  } catch (const rosbag::BagException& e) {
    giveUp();
    throw OutputError("cannot create " + active(path_) + ": " + e.what());
  }
}

void BagOutput::restart() {
  try {
    if (bag_) bag_->close();
  } catch (const rosbag::BagException&) {  // what it held is void; open() meets the same disk
    giveUp();
  }
  open({});
}

void BagOutput::write(const StampedMessage& message) {
  if (!bag_) return;
  try {
    std::visit(
        [&](const auto& content) {
          using Message = std::decay_t<decltype(content)>;
          bag_->write(message.topic, message.stamp, content,
                      message.latched ? latchedHeader<Message>() : nullptr);
        },
        message.message);
  } catch (const rosbag::BagException& e) {
    giveUp();
    throw OutputError("cannot write " + active(path_) + ": " + e.what() +
                      "; is the disk full? free space, choose another out:=, or record:=false");
  }
}

void BagOutput::close() {
  if (!bag_) throw OutputError(active(path_) + " is incomplete");
  try {
    bag_->close();
  } catch (const rosbag::BagException& e) {
    giveUp();
    throw OutputError("cannot close " + active(path_) + ": " + e.what() + "; is the disk full?");
  }
  if (std::rename(active(path_).c_str(), path_.c_str()) != 0) {
    throw OutputError("cannot rename " + active(path_) + ": " + std::strerror(errno));
  }
}

}  // namespace monarch_flight
