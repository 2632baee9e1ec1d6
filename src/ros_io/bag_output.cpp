#include "monarch_flight/ros_io/bag_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "monarch_flight/run/output_file.h"
#include "ros_io/bag_replay.h"

namespace monarch_flight {
namespace {

constexpr char kRemedy[] = "; is the disk full? free space, choose another out:=, or record:=false";

std::string active(const std::string& path) { return path + ".active"; }

// The bag of the part flown before, while its messages are copied.
std::string before(const std::string& path) { return path + ".before"; }

// What rosbag play needs to publish the topic latched again.
template <class Message>
boost::shared_ptr<ros::M_string> latchedHeader(const Message& message) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = ros::message_traits::definition(message);
  (*header)["callerid"] = RunNames().topic("coordinator");
  (*header)["latching"] = "1";
  return header;
}

}  // namespace

BagOutput::BagOutput(const std::string& path) : path_(path) {}

BagOutput::BagOutput(const std::string& path, StateVisitor& resumed) : path_(path) {
  if (resumed.has("bag_messages")) resumed("bag_messages", resumed_);
}

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
  if (!resumed()) return create();
  try {
    takeOver();
  } catch (const OutputError&) {
    throw;
  } catch (const std::exception& e) {
    giveUp();
    throw OutputError(std::string("the bag cannot be taken up again: ") + e.what());
  }
}

void BagOutput::create() {
  messages_ = 0;
  try {
    bag_ = std::make_unique<rosbag::Bag>();
    bag_->open(active(path_), rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::LZ4);
  } catch (const rosbag::BagException& e) {
    giveUp();
    throw OutputError("cannot create " + active(path_) + ": " + e.what());
  }
}

/// Copies what the bag held at the checkpoint. Whatever happens meanwhile, the messages are whole
/// in one of the two files.
void BagOutput::takeOver() {
  namespace fs = std::filesystem;
  if (!fs::exists(before(path_)))
    fs::rename(fs::exists(active(path_)) ? active(path_) : path_, before(path_));
  create();
  replayBag(before(path_), resumed_, [this](const RecordedMessage& message) {
    put(message.topic, message.stamp, message.content, message.latched);
  });
  sync();
  fs::remove(before(path_));
}

void BagOutput::onCheckpoint(StateVisitor& state) {
  state("bag_messages", messages_);
  sync();
}

/// An open chunk is closed by the setting of its size; rosbag has no other way to flush.
void BagOutput::sync() {
  if (!bag_) throw OutputError(active(path_) + " is incomplete");
  try {
    bag_->setChunkThreshold(bag_->getChunkThreshold());
  } catch (const rosbag::BagException& e) {
    giveUp();
    throw OutputError("cannot write " + active(path_) + ": " + e.what() + kRemedy);
  }
  const int descriptor = ::open(active(path_).c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = std::fflush(nullptr) == 0 && descriptor >= 0 && ::fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (synced) return;
  giveUp();
  throw OutputError("cannot write " + active(path_) + ": " + std::strerror(error) + kRemedy);
}

void BagOutput::restart() {
  try {
    if (bag_) bag_->close();
  } catch (const rosbag::BagException&) {  // what it held is void; open() meets the same disk
    giveUp();
  }
  resumed_ = 0;
  create();
}

void BagOutput::write(const StampedMessage& message) {
  std::visit(
      [&](const auto& content) { put(message.topic, message.stamp, content, message.latched); },
      message.message);
}

template <class Message>
void BagOutput::put(const std::string& topic, const ros::Time& stamp, const Message& content,
                    bool latched) {
  if (!bag_) return;
  try {
    bag_->write(topic, stamp, content, latched ? latchedHeader(content) : nullptr);
    ++messages_;
  } catch (const rosbag::BagException& e) {
    giveUp();
    throw OutputError("cannot write " + active(path_) + ": " + e.what() + kRemedy);
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
