#include "monarch_flight/run/run_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

std::string megabytes(std::uint64_t bytes) {
  return std::to_string((bytes + 999999) / 1000000) + " MB";
}

}  // namespace

RunDirectory::RunDirectory(const std::string& path, std::uint64_t needed_bytes, bool resume)
    : path_(path) {
  prepare(resume);
  std::error_code error;
  const fs::space_info space = fs::space(path_, error);
  if (!error && space.available < needed_bytes)
    throw InputError(
        "out = " + path_ + ": its disk has " + megabytes(space.available) +
        " left, the run may write " + megabytes(needed_bytes) +
        "; free space, choose another out:=, or write less (record:=false, fewer flaps)");
  lock();
}

void RunDirectory::prepare(bool resume) const {
  std::error_code error;
  if (fs::exists(path_, error)) {
    if (!fs::is_directory(path_, error))
      throw InputError("out = " + path_ +
                       ": must be a folder, this is a file; choose another out:=");
    if (!resume && (!fs::is_empty(path_, error) || error))
      throw InputError(
          "out = " + path_ +
          ": must be a new or an empty folder, so that no earlier flight is overwritten; "
          "choose another out:= or move that one away");
    return;
  }
  if (resume) throw InputError("resume = " + path_ + ": does not exist; name the folder of a run");
  fs::create_directories(path_, error);
  if (error)
    throw InputError("out = " + path_ + ": cannot be created (" + error.message() +
                     "); choose a folder you may write into with out:=");
}

void RunDirectory::lock() {
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
  if (error == EWOULDBLOCK)
    throw InputError("out = " + path_ +
                     ": another run writes into this folder; wait for its end or stop it");
  throw InputError("out = " + path_ + ": cannot be locked against a second run (" +
                   std::strerror(error) +
                   "); choose a folder on a disk with locks, and that you may read, with out:=");
}

RunDirectory::~RunDirectory() {
  if (lock_ >= 0) ::close(lock_);
}

std::uint64_t estimatedOutputBytes(const Case& c) {
  constexpr std::uint64_t kRow = 2400, kIterationRows = 10 * 260, kSmallFiles = 100000;
  constexpr std::uint64_t kBagStep = 20000, kSurface = 150000, kVortices = 800000;
  constexpr std::uint64_t kFieldCell = 64;  // nine floats and a point of three doubles, packed
  constexpr std::uint64_t kCheckpoints = 3, kStateCell = 72;  // seven fields with their rims
  const std::uint64_t steps = c.time.steps + std::uint64_t{1};
  std::uint64_t bytes = kSmallFiles + c.resolved_yaml.size() + steps * (kRow + kIterationRows);
  if (c.fluid == FluidKind::kNavierStokes) {
    std::uint64_t cells = 0;
    for (Side side : c.sides())
      cells += static_cast<std::uint64_t>(makeGrid(c.insect.wings[side].planform, c.grid).cells());
    if (c.output.fields_every > 0) bytes += steps / c.output.fields_every * cells * kFieldCell;
    if (c.output.checkpoint_every > 0) bytes += kCheckpoints * cells * kStateCell;
  }
  if (!c.output.record) return bytes;
  bytes += steps * kBagStep;
  if (c.output.surface_every > 0)
    bytes += (steps / c.output.surface_every + 1) * c.sides().count * kSurface;
  if (c.fluid == FluidKind::kNavierStokes && c.output.vortices_every > 0)
    bytes += (steps / c.output.vortices_every + 1) * kVortices;
  return bytes;
}

}  // namespace monarch_flight
