#include "monarch_flight/run/run_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
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

/// Of what is solved: cells of the flow, and facets of a picture of pressure, of all wings.
struct Sizes {
  std::uint64_t cells = 0, facets = 0;
};

Sizes sizesOf(const Case& c) {
  constexpr std::uint64_t kStrips = 64;  // of a wing in quasi-steady air
  Sizes sizes;
  for (Side side : c.sides()) {
    if (c.fluid != FluidKind::kNavierStokes) {
      sizes.facets += kStrips;
      continue;
    }
    const Grid grid = makeGrid(c.insect.wings[side].planform, c.grid);
    sizes.cells += static_cast<std::uint64_t>(grid.cells());
    sizes.facets +=
        static_cast<std::uint64_t>(std::count(grid.wing.begin(), grid.wing.end(), std::uint8_t{1}));
  }
  return sizes;
}

/// What a run that goes on has written already; its bag is copied.
std::uint64_t writtenBefore(const std::string& folder) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; entry != end && !error;
       entry.increment(error)) {
    std::error_code none;
    const bool bag = entry->path().filename().string().rfind("flight.bag", 0) == 0;
    if (!bag && entry->is_regular_file(none)) bytes += entry->file_size(none);
  }
  return bytes;
}

}  // namespace

RunDirectory::RunDirectory(const std::string& path, std::uint64_t needed_bytes, bool resume)
    : path_(path) {
  prepare(resume);
  std::error_code error;
  const fs::space_info space = fs::space(path_, error);
  if (resume) needed_bytes -= std::min(needed_bytes, writtenBefore(path_));
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

// Bytes as measured (docs/run_files.md), a quarter up: free flights with motion, controller and
// independent wings in quasi-steady air, and in Navier-Stokes air on the preview grid.
std::uint64_t estimatedOutputBytes(const Case& c) {
  constexpr std::uint64_t kRow = 1600, kIterationRows = 3 * 225, kSmallFiles = 20000;
  const std::uint64_t steps = c.time.steps + std::uint64_t{1};
  const Sizes sizes = sizesOf(c);
  std::uint64_t bytes = kSmallFiles + c.resolved_yaml.size() + steps * (kRow + kIterationRows);
  if (c.output.fields_every > 0) {
    constexpr std::uint64_t kFieldCell = 64;  // nine floats and a point of three doubles, packed
    bytes += steps / c.output.fields_every * sizes.cells * kFieldCell;
  }
  if (c.output.checkpoint_every > 0) {
    // The last two, and one that is being written; one at the end, whatever that is.
    constexpr std::uint64_t kMost = 3, kStateCell = 72, kCheckpoint = 60000;
    const std::uint64_t one =
        kCheckpoint + 5 * c.resolved_yaml.size() / 2 + sizes.cells * kStateCell;
    bytes += std::min(kMost, steps / c.output.checkpoint_every + 1) * one;
  }
  if (!c.output.record) return bytes;
  constexpr std::uint64_t kBag = 60000, kBagStep = 1800, kBagFacet = 24, kBagPoint = 4;
  bytes += kBag + steps * kBagStep;
  if (c.output.surface_every > 0)
    bytes += (steps / c.output.surface_every + 1) * sizes.facets * kBagFacet;
  if (c.fluid == FluidKind::kNavierStokes && c.output.flow_every > 0)
    bytes += steps / c.output.flow_every * c.sides().count * c.output.flow_points * kBagPoint;
  return bytes;
}

}  // namespace monarch_flight
