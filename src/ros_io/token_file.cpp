#include "monarch_flight/ros_io/token_file.h"

#include <fcntl.h>
#include <ros/time.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/master.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRandomBytes = 32, kFewest = 16, kMost = 4096;
const ros::WallDuration kPatience(30.0), kLook(0.02);

std::string pathOf(const RunNames& names) {
  XmlRpc::XmlRpcValue value = parametersOf(names.topic(kTokenFileKey));
  return value.getType() == XmlRpc::XmlRpcValue::TypeString ? static_cast<std::string>(value) : "";
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(std::string(kTokenFileKey) + " = " + path + ": " + why);
}

std::string randomText() {
  std::array<unsigned char, kRandomBytes> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InputError("token: the system's random source gives nothing");
  std::string text;
  for (const unsigned char byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

/// A descriptor that closes itself.
struct Descriptor {
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

/// What the file holds, without white space at its end; empty where there is no such file.
std::string secretIn(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number < 0) {
    if (errno == ENOENT) return "";
    refuse(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  struct stat facts {};
  if (::fstat(file.number, &facts) != 0 || !S_ISREG(facts.st_mode)) refuse(path, "is no file");
  if (facts.st_uid != geteuid()) refuse(path, "belongs to another user; name a file of your own");
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    refuse(path, "others can read or write it; chmod 600 it");
  std::string text(kMost, '\0');
  const ssize_t size = ::read(file.number, text.data(), text.size());
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  if (text.size() < kFewest)
    refuse(path, "holds " + std::to_string(text.size()) + " characters; a token has at least " +
                     std::to_string(kFewest));
  return text;
}

/// The file appears whole, under its name.
void make(const std::string& path, const std::string& secret) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code failed;
  if (!folder.empty() && !fs::exists(folder, failed)) {
    fs::create_directories(folder, failed);
    fs::permissions(folder, fs::perms::owner_all, failed);
  }
  const std::string active = path + ".active";
  const Descriptor file(
      ::open(active.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  const std::string text = secret + "\n";
  const bool written = file.number >= 0 && ::write(file.number, text.data(), text.size()) ==
                                               static_cast<ssize_t>(text.size());
  if (!written || std::rename(active.c_str(), path.c_str()) != 0)
    refuse(path, std::string("cannot be made: ") + std::strerror(errno) + "; name another place");
}

}  // namespace

TokenFile::TokenFile(const RunNames& names) {
  const std::string path = pathOf(names);
  if (path.empty()) return;
  std::string secret = secretIn(path);
  if (secret.empty()) {
    secret = randomText();
    make(path, secret);
    made_ = path;
  }
  token_ = Token(secret);
}

TokenFile::~TokenFile() { remove(); }

void TokenFile::remove() noexcept {
  if (!made_.empty()) ::unlink(made_.c_str());
  made_.clear();
}

Token tokenOfRun(const RunNames& names, const StopFlag& stop) {
  const std::string path = pathOf(names);
  if (path.empty()) return Token();
  const ros::WallTime end = ros::WallTime::now() + kPatience;
  for (std::string secret = secretIn(path); !stop && ros::WallTime::now() < end;
       secret = secretIn(path)) {
    if (!secret.empty()) return Token(secret);
    kLook.sleep();
  }
  if (stop) throw InputError("interrupted while waiting for the token of the run");
  refuse(path,
         "there is no such file after 30 s: is the coordinator running? On several machines, "
         "make a file of 32 random characters, copy it to each, chmod 600 it, and give its "
         "path by token_file:=");
}

}  // namespace monarch_flight
