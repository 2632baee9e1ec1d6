#include "monarch_flight/run/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

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

// The rename is durable only when the folder is.
void syncFolder(const std::string& path) {
  const int folder = ::open(folderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  descriptor_ = ::open(active(path_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("cannot be created", errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view bytes) {
  if (failed()) throw OutputError(failure_);
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
  syncFolder(path_);
}

void OutputFile::fail(const char* what, int error) {
  failure_ = active(path_) + " " + what + " (" + std::strerror(error) + "): " + remedy(error);
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  throw OutputError(failure_);
}

}  // namespace monarch_flight
