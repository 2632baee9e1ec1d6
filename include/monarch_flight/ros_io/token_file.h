#pragma once
#include <string>
#include <utility>

#include "monarch_flight/coupling/stop_flag.h"
#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/ros_io/token.h"

namespace monarch_flight {

/// Parameter of the run's namespace: path of the file that holds its token; a relative one starts
/// at the parameter `directory`. The file is readable by its owner alone; the parameter may be read
/// by everybody.
constexpr char kTokenFileKey[] = "token_file";

/// Whether a coordinator has made the file that holds this; else a person has.
bool madeByACoordinator(const std::string& secret);

/// An open file, closed with the object; a negative number: none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();

  int number() const { return number_; }

 private:
  int number_;
};

/// The coordinator's end: the token of a new run in a file, from the system's random source. The
/// file is locked (flock) while this lives: one that is not was left by a run that was killed, and
/// is replaced. A file that no coordinator has made is used as it is: who flies on several machines
/// makes one and copies it.
class TokenFile {
 public:
  /// Without the parameter: an empty token. Throws InputError naming the file: it cannot be made,
  /// is that of another run, belongs to another user, is readable by others, or holds less than 16
  /// characters.
  explicit TokenFile(const RunNames& names);
  ~TokenFile();
  TokenFile(const TokenFile&) = delete;
  TokenFile& operator=(const TokenFile&) = delete;

  const Token& token() const { return token_; }
  /// All nodes of the run have it: removes the file, if this has made it.
  void remove() noexcept;

 private:
  std::string secret();

  std::string path_;
  Descriptor made_;  // the file that this has made
  Token token_;
};

/// The participants' end: waits until the coordinator has made the file, 30 s at most or until
/// `stop`. Throws InputError, as TokenFile.
Token tokenOfRun(const RunNames& names, const StopFlag& stop);

}  // namespace monarch_flight
