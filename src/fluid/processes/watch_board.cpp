#include "fluid/processes/watch_board.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <new>

namespace monarch_flight::fluid::processes {
namespace {

constexpr int kNameLength = 64;

/// Zeroed memory for `count` slots that nobody shares, or that of the file; null where there is
/// none.
WatchSlot* mapped(int file, int count) {
  void* memory =
      mmap(nullptr, sizeof(WatchSlot) * static_cast<std::size_t>(count), PROT_READ | PROT_WRITE,
           file < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED, file, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<WatchSlot*>(memory);
}

/// The same memory on all processes of `here`, or null on all of them.
WatchSlot* shared(MPI_Comm here, int rank, int count) {
  char name[kNameLength] = "";
  int file = -1;
  if (rank == 0) {
    const long long now = std::chrono::steady_clock::now().time_since_epoch().count();
    std::snprintf(name, sizeof name, "/monarch_flight.%d.%llx", static_cast<int>(getpid()), now);
    file = shm_open(name, O_RDWR | O_CREAT | O_EXCL, 0600);
    if (file >= 0 && ftruncate(file, static_cast<off_t>(sizeof(WatchSlot)) * count) != 0) {
      close(file);
      file = -1;
    }
  }
  MPI_Bcast(name, kNameLength, MPI_CHAR, 0, here);
  if (rank > 0) file = shm_open(name, O_RDWR, 0);
  WatchSlot* slots = file >= 0 ? mapped(file, count) : nullptr;
  if (file >= 0) close(file);
  int all = slots != nullptr;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, here);
  if (rank == 0) shm_unlink(name);
  if (all) return slots;
  if (slots != nullptr) munmap(slots, sizeof(WatchSlot) * static_cast<std::size_t>(count));
  return nullptr;
}

}  // namespace

WatchBoard::WatchBoard(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm here;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &here);
  MPI_Comm_rank(here, &own_);
  MPI_Comm_size(here, &size_);
  slots_ = shared(here, own_, size_);
  if (slots_ == nullptr) {
    own_ = 0;
    size_ = 1;
    slots_ = mapped(-1, 1);
    if (slots_ == nullptr) throw std::bad_alloc();
  }
  own().rank = rank;
  own().pid = getpid();
  MPI_Barrier(here);  // until all have said who they are
  MPI_Comm_free(&here);
}

WatchBoard::~WatchBoard() { munmap(slots_, sizeof(WatchSlot) * static_cast<std::size_t>(size_)); }

}  // namespace monarch_flight::fluid::processes
