#include "monarch_flight/run/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

namespace monarch_flight {
namespace {

const char* remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free space on that disk or choose another folder with out:=";
    case EFBIG:
      return "raise the limit on file size (ulimit -f) or choose another folder with out:=";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder you may write into with out:=";
    default:
      return "check that disk or choose another folder with out:=";
  }
}

std::string active(const std::string& path) { return path + ".active"; }

std::string folderOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

// The first `size` bytes of a file into a hash; false when it is shorter or cannot be read.
bool hashFile(const std::string& path, std::uint64_t size, Sha256& hash) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(1 << 16);
  while (size > 0) {
    const std::uint64_t n = std::min<std::uint64_t>(size, piece.size());
    if (!file.read(piece.data(), static_cast<std::streamsize>(n))) return false;
    hash.add(piece.data(), n);
    size -= n;
  }
  return true;
}

}  // namespace

std::string problem(const std::string& path, const OutputMark& mark) {
  const bool growing = ::access(active(path).c_str(), F_OK) == 0;
  const std::string file = growing ? active(path) : path;
  if (::access(file.c_str(), R_OK) != 0) return file + " cannot be read";
  Sha256 hash;
  if (!hashFile(file, mark.bytes, hash))
    return file + " has fewer than the " + std::to_string(mark.bytes) + " bytes it had then";
  if (hash.hex() != mark.sha256) return file + " does not begin with the bytes it had then";
  return "";
}

// The rename is durable only when the folder is.
void syncFolderOf(const std::string& path) {
  const int folder = ::open(folderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

OutputFile::OutputFile(const std::string& path, const OutputMark& mark) : path_(path) {
  failure_ = problem(path, mark);
  if (failed()) throw OutputError(failure_);
  if (::access(active(path_).c_str(), F_OK) != 0 &&
      std::rename(path_.c_str(), active(path_).c_str()) != 0)
    fail("cannot be renamed", errno);
  descriptor_ = ::open(active(path_).c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail("cannot be opened", errno);
  if (::ftruncate(descriptor_, static_cast<off_t>(mark.bytes)) != 0 ||
      ::lseek(descriptor_, 0, SEEK_END) < 0)
    fail("cannot be cut to the length of the checkpoint", errno);
  bytes_ = mark.bytes;
  hashFile(active(path_), bytes_, hash_);
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
  descriptor_ = ::open(active(path_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("cannot be created", errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view bytes) {
  if (failed()) throw OutputError(failure_);
  bytes_ += bytes.size();
  hash_.add(bytes.data(), bytes.size());
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void OutputFile::finish() {
  if (failed()) throw OutputError(failure_);
  if (::fsync(descriptor_) != 0) fail("cannot be flushed to the disk", errno);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("cannot be closed", errno);
  if (std::rename(active(path_).c_str(), path_.c_str()) != 0) fail("cannot be renamed", errno);
  syncFolderOf(path_);
}

OutputMark OutputFile::mark() {
  if (failed()) throw OutputError(failure_);
  if (::fsync(descriptor_) != 0) fail("cannot be flushed to the disk", errno);
  return {bytes_, hash_.hex()};
}

void writeWhole(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.finish();
}

void OutputFile::fail(const char* what, int error) {
  failure_ = active(path_) + " " + what + " (" + std::strerror(error) + "): " + remedy(error);
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  throw OutputError(failure_);
}

}  // namespace monarch_flight
