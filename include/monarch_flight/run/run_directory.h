#pragma once
#include <cstdint>
#include <string>

#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// The folder a run writes into.
class RunDirectory {
 public:
  /// Creates `path` with its parents. Throws InputError with every fault when it cannot be created,
  /// is not a folder, is not empty, or its disk holds less than `needed_bytes`.
  /// With `resume` it must exist instead, and may hold files. The folder is locked for as long as
  /// the object lives, so that no two runs write into it.
  RunDirectory(const std::string& path, std::uint64_t needed_bytes, bool resume = false);
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  void prepare(bool resume) const;
  void lock();

  std::string path_;
  int lock_ = -1;  // descriptor of the folder
};

/// Upper estimate of what the run writes: tables, checkpoints, fields, and the bag when it is
/// recorded; less than twice what usual flights write [bytes].
std::uint64_t estimatedOutputBytes(const Case& c);

}  // namespace monarch_flight
