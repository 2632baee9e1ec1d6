#include "fluid/fields/slab.h"

#include <algorithm>
#include <string>

#include "fluid/processes/peer_watch.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight::fluid {
namespace {
constexpr int kTag = 17;
}

Slab::Slab(MPI_Comm comm, int planes) : comm_(comm), k0_(0), k1_(planes) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  if (planes < 2 * ranks_) {
    throw InputError(
        "ranks = " + std::to_string(ranks_) + ": must be at most " + std::to_string(planes / 2) +
        ", half the planes of the grid normal to the wing; use fewer processes or a finer grid");
  }
  k0_ = static_cast<int>(static_cast<long>(planes) * rank_ / ranks_);
  k1_ = static_cast<int>(static_cast<long>(planes) * (rank_ + 1) / ranks_);
}

void Slab::send(const double* data, int n, int to) const {
  const processes::PeerWait wait(to);
  MPI_Send(data, n, MPI_DOUBLE, to, kTag, comm_);
  *sent_ += n;
}

void Slab::receive(double* data, int n, int from) const {
  const processes::PeerWait wait(from);
  MPI_Recv(data, n, MPI_DOUBLE, from, kTag, comm_, MPI_STATUS_IGNORE);
}

void Slab::exchange(const double* mine, double* other, int n, int with) const {
  const processes::PeerWait wait(with);
  MPI_Sendrecv(mine, n, MPI_DOUBLE, with, kTag, other, n, MPI_DOUBLE, with, kTag, comm_,
               MPI_STATUS_IGNORE);
  *sent_ += n;
}

void Slab::shift(const double* out, double* in, int n, int direction) const {
  const int to = rank_ + direction, from = rank_ - direction;
  const bool sends = to >= 0 && to < ranks_, receives = from >= 0 && from < ranks_;
  const processes::PeerWait wait(receives ? from : to);
  MPI_Sendrecv(out, sends ? n : 0, MPI_DOUBLE, sends ? to : MPI_PROC_NULL, kTag, in,
               receives ? n : 0, MPI_DOUBLE, receives ? from : MPI_PROC_NULL, kTag, comm_,
               MPI_STATUS_IGNORE);
  if (sends) *sent_ += n;
}

void Slab::sum(double* values, int n) const {
  if (ranks_ == 1) return;
  const processes::PeerWait wait(processes::WatchSlot::kEverybody);
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, comm_);
}

double Slab::max(double value) const {
  if (ranks_ == 1) return value;
  const processes::PeerWait wait(processes::WatchSlot::kEverybody);
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return value;
}

std::vector<char> Slab::gather(const std::vector<char>& mine, std::size_t piece) const {
  if (ranks_ == 1) return mine;
  const long long size = static_cast<long long>(mine.size());
  std::vector<long long> sizes(ranks_);
  const processes::PeerWait wait(rank_ == 0 ? processes::WatchSlot::kEverybody : 0);
  MPI_Gather(&size, 1, MPI_LONG_LONG, sizes.data(), 1, MPI_LONG_LONG, 0, comm_);
  if (rank_ > 0) {
    for (std::size_t at = 0; at < mine.size(); at += piece) {
      const int n = static_cast<int>(std::min(piece, mine.size() - at));
      MPI_Send(mine.data() + at, n, MPI_CHAR, 0, kTag, comm_);
    }
    return {};
  }
  std::size_t total = 0;
  for (const long long one : sizes) total += static_cast<std::size_t>(one);
  std::vector<char> all;
  all.reserve(total);
  all = mine;
  all.resize(total);
  std::size_t at = mine.size();
  for (int r = 1; r < ranks_; ++r) {
    for (const std::size_t end = at + static_cast<std::size_t>(sizes[r]); at < end;) {
      const int n = static_cast<int>(std::min(piece, end - at));
      MPI_Recv(all.data() + at, n, MPI_CHAR, r, kTag, comm_, MPI_STATUS_IGNORE);
      at += static_cast<std::size_t>(n);
    }
  }
  return all;
}

}  // namespace monarch_flight::fluid
