#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace monarch_flight {

/// A file of the run cannot be written: message names the file, the reason and the remedy.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that carries its name only when it is whole: bytes go to `<path>.active`, and `finish`
/// makes them durable and renames. Whatever happens before leaves the file under its active name.
class OutputFile {
 public:
  /// Creates `<path>.active`. Throws OutputError.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands the bytes to the operating system. Throws OutputError (disk full, file too large, ...);
  /// the file is then closed and further calls throw again.
  void write(std::string_view bytes);
  /// Flushes to the disk, closes and renames to `path`. Throws OutputError.
  void finish();
  bool failed() const { return !failure_.empty(); }
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail(const char* what, int error);

  std::string path_;
  std::string failure_;
  int descriptor_ = -1;
};

}  // namespace monarch_flight
