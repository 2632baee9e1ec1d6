#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/run/state_record.h"

namespace monarch_flight {

/// What manifest.json says of a checkpoint besides the digests of its files.
struct CheckpointFacts {
  std::uint32_t step = 0;
  std::string version;  ///< of the program that made it
  std::string case_name, case_sha256;
  int ranks = 0;  ///< processes of the flow, which the fluid's part fits; 0: not told
};

/// The folder `<run>/checkpoints`: a folder `step_<n>` for each checkpoint that counts, with one
/// HDF5 file for each part and manifest.json, which holds size and SHA-256 of all of them and of
/// itself. While it is made it is called step_<n>.active; everything is on the disk before it gets
/// its name.
class CheckpointFiles {
 public:
  explicit CheckpointFiles(std::string folder) : folder_(std::move(folder)) {}

  /// Begins a checkpoint; leftovers of unfinished ones go. Throws OutputError.
  void open(std::uint32_t step) const;
  /// Writes a part of the open checkpoint: `<part>.h5`. Throws OutputError.
  void write(std::uint32_t step, const std::string& part, const StateRecord& record) const;
  /// Ends it: from here on it counts, and all but the last two go. Throws OutputError, also where a
  /// file of one of `parts` is missing (a solver of another make may give it its own ending).
  void close(const CheckpointFacts& facts, const std::vector<std::string>& parts) const;

  /// Steps of the checkpoints there are, the newest first; they may be damaged.
  std::vector<std::uint32_t> steps() const;
  /// Compares every file with the manifest. Throws CheckpointError naming file and fault.
  CheckpointFacts verify(std::uint32_t step) const;
  /// The part of a checkpoint. Throws CheckpointError.
  StateRecord read(std::uint32_t step, const std::string& part) const;
  void remove(std::uint32_t step) const noexcept;
  /// Puts a checkpoint that cannot be used out of the way: step_<n>.refused.
  void refuse(std::uint32_t step) const noexcept;

  /// Path of a checkpoint's folder.
  std::string path(std::uint32_t step) const;
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

}  // namespace monarch_flight
