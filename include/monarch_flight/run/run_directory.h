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
  RunDirectory(const std::string& path, std::uint64_t needed_bytes);

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Upper estimate of what the run writes: tables, and the bag when it is recorded [bytes].
std::uint64_t estimatedOutputBytes(const Case& c);

}  // namespace monarch_flight
