#include "monarch_flight/ros_io/token_file.h"

#include <fcntl.h>
#include <ros/time.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/early_end.h"
#include "monarch_flight/ros_io/master.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRandomBytes = 32, kFewest = 16, kMost = 4096;
constexpr char kOfOneRun[] = "of one run: ";  // what a coordinator has made begins with it
const ros::WallDuration kOwnerPatience(30.0), kPause(0.02);
constexpr int kLooks = 25;  // at a file that another process may hold for a moment, to look at it

std::string text(const RunNames& names, const char* key) {
  XmlRpc::XmlRpcValue value = parametersOf(names.topic(key));
  return value.getType() == XmlRpc::XmlRpcValue::TypeString ? static_cast<std::string>(value) : "";
}

/// Absolute; empty where it is not given.
std::string pathOf(const RunNames& names) {
  const std::string path = text(names, kTokenFileKey);
  if (path.empty() || path == "auto") return "";
  return fs::absolute(text(names, "directory") / fs::path(path)).lexically_normal();
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(std::string(kTokenFileKey) + " = " + path + ": " + why);
}

std::string randomText() {
  std::array<unsigned char, kRandomBytes> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InputError("token: the system's random source gives nothing");
  std::string text = kOfOneRun;
  for (const unsigned char byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

/// What the file holds, without white space at its end.
std::string secretIn(const Descriptor& file, const std::string& path) {
  struct stat facts {};
  if (::fstat(file.number(), &facts) != 0 || !S_ISREG(facts.st_mode)) refuse(path, "is no file");
  if (facts.st_uid != geteuid()) refuse(path, "belongs to another user; name a file of your own");
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    refuse(path, "others can read or write it; chmod 600 it");
  std::string text(kMost, '\0');
  const ssize_t size = ::read(file.number(), text.data(), text.size());
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  if (text.size() < kFewest)
    refuse(path, "holds " + std::to_string(text.size()) + " characters; a token has at least " +
                     std::to_string(kFewest));
  return text;
}

/// The open file; none (a negative number) where there is none.
Descriptor opened(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0 && errno != ENOENT)
    refuse(path, std::string("cannot be read: ") + std::strerror(errno));
  return file;
}

/// Whether the coordinator that has made it still holds it: the lock goes with its process.
bool held(const Descriptor& file) {
  const bool free = ::flock(file.number(), LOCK_SH | LOCK_NB) == 0;
  if (free) ::flock(file.number(), LOCK_UN);
  return !free;
}

/// Whether the file is still the one of that name.
bool named(const Descriptor& file, const std::string& path) {
  struct stat here {
  }, there{};
  return ::fstat(file.number(), &here) == 0 && ::stat(path.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

[[noreturn]] void cannotBeMade(const std::string& path) {
  refuse(path, std::string("cannot be made: ") + std::strerror(errno) + "; name another place");
}

/// Folders that are made are their owner's alone.
void makeFolders(const fs::path& folder) {
  if (folder.empty() || fs::exists(folder)) return;
  makeFolders(folder.parent_path());
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) cannotBeMade(folder);
}

/// A new file with the secret, held by this process, under another name in the folder of `path`;
/// the name is taken away with the object.
struct NewFile {
  NewFile(const std::string& path, const std::string& secret) : name(path + ".XXXXXX") {
    const std::string text = secret + "\n";
    file = Descriptor(::mkostemp(name.data(), O_CLOEXEC));  // 0600
    const bool made = file.number() >= 0;
    if (!made ||
        ::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
        ::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
      const int why = errno;
      if (made) ::unlink(name.c_str());
      errno = why;
      cannotBeMade(path);
    }
  }
  ~NewFile() { ::unlink(name.c_str()); }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  std::string name;
  Descriptor file;
};

/// Takes the place of a file whose coordinator is gone. False where another process has done so.
bool replaced(const Descriptor& old, const std::string& path, const NewFile& made) {
  for (int look = 0; ::flock(old.number(), LOCK_EX | LOCK_NB) != 0; ++look) {
    if (look == kLooks)
      refuse(path, "is the token of another run, which goes on; name another file, or none");
    kPause.sleep();
  }
  if (!named(old, path)) return false;
  if (std::rename(made.name.c_str(), path.c_str()) != 0) cannotBeMade(path);
  return true;
}

}  // namespace

bool madeByACoordinator(const std::string& secret) { return secret.rfind(kOfOneRun, 0) == 0; }

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

TokenFile::TokenFile(const RunNames& names) : path_(pathOf(names)) {
  if (!path_.empty()) token_ = Token(secret());
}

/// Of the file that is there, or of a new one, which appears whole and held under its name.
std::string TokenFile::secret() {
  std::optional<NewFile> made;
  const std::string fresh = randomText();
  while (true) {
    const Descriptor old = opened(path_);
    if (old.number() >= 0) {
      const std::string known = secretIn(old, path_);
      if (!madeByACoordinator(known)) return known;
    }
    if (!made) {
      makeFolders(fs::path(path_).parent_path());
      made.emplace(path_, fresh);
    }
    const bool done = old.number() >= 0 ? replaced(old, path_, *made)
                                        : ::link(made->name.c_str(), path_.c_str()) == 0;
    if (done) break;
    if (old.number() < 0 && errno != EEXIST) cannotBeMade(path_);
  }
  made_ = std::move(made->file);
  return fresh;
}

TokenFile::~TokenFile() { remove(); }

void TokenFile::remove() noexcept {
  if (made_.number() >= 0 && named(made_, path_)) ::unlink(path_.c_str());
  made_ = Descriptor();
}

Token tokenOfRun(const RunNames& names, const StopFlag& stop) {
  const std::string path = pathOf(names);
  if (path.empty()) return Token();
  const ros::WallTime end = ros::WallTime::now() + kOwnerPatience;
  EarlyEnd coordinator(names.space(), "coordinator", "the coordinator");
  while (!stop && ros::WallTime::now() < end) {
    const Descriptor file = opened(path);
    if (file.number() >= 0) {
      const std::string secret = secretIn(file, path);
      if (!madeByACoordinator(secret) || held(file)) return Token(secret);
    }
    coordinator.refuse();
    kPause.sleep();
  }
  if (stop) throw InputError("interrupted while waiting for the token of the run");
  refuse(path,
         "there is no such file after 30 s: is the coordinator running? On several machines, "
         "make a file of 32 random characters, copy it to each, chmod 600 it, and give its "
         "path by token_file:=");
}

}  // namespace monarch_flight
