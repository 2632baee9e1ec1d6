#include "ros_io/bag_replay.h"

#include <ros/header.h>
#include <roslz4/lz4s.h>

#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

namespace monarch_flight {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0\n";
constexpr std::uint8_t kMessageData = 2, kChunk = 5, kConnection = 7;
constexpr std::uint32_t kLargest = 1u << 30;  // of a header or of data: more is damage

using Fields = ros::M_string;

template <class T>
T number(const Fields& fields, const char* name) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(T))
    throw std::runtime_error(std::string("a record without ") + name);
  T value;
  std::memcpy(&value, found->second.data(), sizeof value);
  return value;
}

std::string text(const Fields& fields, const char* name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "" : found->second;
}

Fields parsed(std::uint8_t* bytes, std::uint32_t size) {
  ros::Header header;
  std::string error;
  if (!header.parse(bytes, size, error)) throw std::runtime_error("a damaged record: " + error);
  return *header.getValues();
}

// Records one after the other in memory: header, data.
class Records {
 public:
  explicit Records(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  bool next(Fields& fields, std::uint8_t*& data, std::uint32_t& size) {
    if (at_ == bytes_.size()) return false;
    const std::uint32_t header = length();
    fields = parsed(take(header), header);
    size = length();
    data = take(size);
    return true;
  }

 private:
  std::uint32_t length() {
    std::uint32_t value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::uint8_t* take(std::uint32_t n) {
    if (n > bytes_.size() - at_) throw std::runtime_error("a chunk that ends within a record");
    at_ += n;
    return bytes_.data() + at_ - n;
  }
  std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

// Records one after the other in a file; the last one may be cut short.
bool readPiece(std::ifstream& file, std::vector<std::uint8_t>& piece) {
  std::uint32_t size = 0;
  if (!file.read(reinterpret_cast<char*>(&size), sizeof size) || size > kLargest) return false;
  piece.resize(size);
  return static_cast<bool>(file.read(reinterpret_cast<char*>(piece.data()), size));
}

std::vector<std::uint8_t> unpacked(std::vector<std::uint8_t>& data, const Fields& chunk) {
  const std::string compression = text(chunk, "compression");
  if (compression == "none") return data;
  if (compression != "lz4") throw std::runtime_error("a chunk packed by " + compression);
  unsigned int size = number<std::uint32_t>(chunk, "size");
  std::vector<std::uint8_t> plain(size);
  if (roslz4_buffToBuffDecompress(reinterpret_cast<char*>(data.data()),
                                  static_cast<unsigned int>(data.size()),
                                  reinterpret_cast<char*>(plain.data()), &size) != ROSLZ4_OK)
    throw std::runtime_error("a damaged chunk");
  plain.resize(size);
  return plain;
}

class Replay {
 public:
  Replay(std::uint64_t count, const std::function<void(const RecordedMessage&)>& take)
      : left_(count), take_(take) {}
  std::uint64_t left() const { return left_; }

  void chunk(std::vector<std::uint8_t> plain) {
    Records records(plain);
    Fields fields;
    std::uint8_t* data = nullptr;
    std::uint32_t size = 0;
    while (left_ > 0 && records.next(fields, data, size)) {
      const auto op = number<std::uint8_t>(fields, "op");
      if (op == kConnection) connect(fields, parsed(data, size));
      if (op == kMessageData) message(fields, data, size);
    }
  }

 private:
  void connect(const Fields& record, const Fields& header) {
    RecordedMessage& message = connections_[number<std::uint32_t>(record, "conn")];
    message.topic = text(record, "topic");
    message.latched = text(header, "latching") == "1";
    message.content.morph(text(header, "md5sum"), text(header, "type"),
                          text(header, "message_definition"), text(header, "latching"));
  }
  void message(const Fields& record, std::uint8_t* data, std::uint32_t size) {
    const auto connection = connections_.find(number<std::uint32_t>(record, "conn"));
    if (connection == connections_.end()) throw std::runtime_error("a message of no topic");
    const auto stamp = number<std::uint64_t>(record, "time");
    RecordedMessage& message = connection->second;
    message.stamp = ros::Time(static_cast<std::uint32_t>(stamp & 0xffffffffu),
                              static_cast<std::uint32_t>(stamp >> 32));
    ros::serialization::IStream stream(data, size);
    message.content.read(stream);
    take_(message);
    --left_;
  }

  std::uint64_t left_;
  const std::function<void(const RecordedMessage&)>& take_;
  std::map<std::uint32_t, RecordedMessage> connections_;
};

}  // namespace

void replayBag(const std::string& path, std::uint64_t count,
               const std::function<void(const RecordedMessage&)>& take) {
  Replay replay(count, take);
  std::string why;
  try {
    std::ifstream file(path, std::ios::binary);
    std::string magic(sizeof kMagic - 1, ' ');
    if (!file.read(magic.data(), static_cast<std::streamsize>(magic.size())) || magic != kMagic)
      throw std::runtime_error("no bag of version 2.0");
    std::vector<std::uint8_t> header, data;
    while (replay.left() > 0 && readPiece(file, header) && readPiece(file, data)) {
      const Fields fields = parsed(header.data(), static_cast<std::uint32_t>(header.size()));
      if (number<std::uint8_t>(fields, "op") == kChunk) replay.chunk(unpacked(data, fields));
    }
  } catch (const std::runtime_error& e) {
    why = std::string(" (") + e.what() + ")";
  }
  if (replay.left() > 0)
    throw std::runtime_error(path + " lacks " + std::to_string(replay.left()) + " of the " +
                             std::to_string(count) + " messages it had at the checkpoint" + why);
}

}  // namespace monarch_flight
