#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "monarch_flight/run/sha256.h"

namespace monarch_flight {

/// A file of the run cannot be written: message names the file, the reason and the remedy.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How far a file had grown at a checkpoint.
struct OutputMark {
  std::uint64_t bytes = 0;
  std::string sha256;  ///< of these bytes
};
/// Why `path`, finished or active, cannot go on from the mark: missing, too short, changed. Empty:
/// it can.
std::string problem(const std::string& path, const OutputMark& mark);
/// Makes the names in the folder of `path` durable.
void syncFolderOf(const std::string& path);

/// A file that carries its name only when it is whole: bytes go to `<path>.active`, and `finish`
/// makes them durable and renames. Whatever happens before leaves the file under its active name.
class OutputFile {
 public:
  /// Creates `<path>.active`. Throws OutputError.
  explicit OutputFile(const std::string& path);
  /// Goes on from a mark: what came behind it is cut off, and a finished file becomes active again.
  /// Throws OutputError (see `problem`).
  OutputFile(const std::string& path, const OutputMark& mark);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands the bytes to the operating system. Throws OutputError (disk full, file too large, ...);
  /// the file is then closed and further calls throw again.
  void write(std::string_view bytes);
  /// Flushes to the disk, closes and renames to `path`. Throws OutputError.
  void finish();
  /// Flushes to the disk; where the file stands. Throws OutputError.
  OutputMark mark();
  bool failed() const { return !failure_.empty(); }
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail(const char* what, int error);

  std::string path_;
  std::string failure_;
  int descriptor_ = -1;
  std::uint64_t bytes_ = 0;
  Sha256 hash_;
};

/// A whole file at once. Throws OutputError.
void writeWhole(const std::string& path, std::string_view bytes);

}  // namespace monarch_flight
