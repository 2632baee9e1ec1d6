#pragma once
#include <string>

#include "monarch_flight/coupling/stop_flag.h"
#include "monarch_flight/ros_io/run_names.h"
#include "monarch_flight/ros_io/token.h"

namespace monarch_flight {

/// Parameter of the run's namespace: path of the file that holds its token. The file is readable by
/// its owner alone; the parameter may be read by everybody.
constexpr char kTokenFileKey[] = "token_file";

/// The coordinator's end: the token of a new run in a file, from the system's random source. A file
/// that is there already is used as it is: who flies on several machines makes one and copies it.
class TokenFile {
 public:
  /// Without the parameter: an empty token. Throws InputError naming the file: it cannot be made,
  /// belongs to another user, is readable by others, or holds less than 16 characters.
  explicit TokenFile(const RunNames& names);
  ~TokenFile();
  TokenFile(const TokenFile&) = delete;
  TokenFile& operator=(const TokenFile&) = delete;

  const Token& token() const { return token_; }
  /// All nodes of the run have it: removes the file, if this has made it.
  void remove() noexcept;

 private:
  std::string made_;  // the file that this has made
  Token token_;
};

/// The participants' end: waits until the coordinator has made the file, 30 s at most or until
/// `stop`. Throws InputError, as TokenFile.
Token tokenOfRun(const RunNames& names, const StopFlag& stop);

}  // namespace monarch_flight
