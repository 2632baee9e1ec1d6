#include "fluid/slab.h"

#include <string>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
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
  MPI_Send(data, n, MPI_DOUBLE, to, kTag, comm_);
  *sent_ += n;
}

void Slab::receive(double* data, int n, int from) const {
  MPI_Recv(data, n, MPI_DOUBLE, from, kTag, comm_, MPI_STATUS_IGNORE);
}

void Slab::exchange(const double* mine, double* other, int n, int with) const {
  MPI_Sendrecv(mine, n, MPI_DOUBLE, with, kTag, other, n, MPI_DOUBLE, with, kTag, comm_,
               MPI_STATUS_IGNORE);
  *sent_ += n;
}

void Slab::shift(const double* out, double* in, int n, int direction) const {
  const int to = rank_ + direction, from = rank_ - direction;
  const bool sends = to >= 0 && to < ranks_, receives = from >= 0 && from < ranks_;
  MPI_Sendrecv(out, sends ? n : 0, MPI_DOUBLE, sends ? to : MPI_PROC_NULL, kTag, in,
               receives ? n : 0, MPI_DOUBLE, receives ? from : MPI_PROC_NULL, kTag, comm_,
               MPI_STATUS_IGNORE);
  if (sends) *sent_ += n;
}

void Slab::sum(double* values, int n) const {
  if (ranks_ > 1) MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, comm_);
}

double Slab::max(double value) const {
  if (ranks_ > 1) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return value;
}

std::vector<char> Slab::gather(const std::vector<char>& mine) const {
  if (ranks_ == 1) return mine;
  const int size = static_cast<int>(mine.size());
  std::vector<int> sizes(ranks_), starts(ranks_);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, comm_);
  int total = 0;
  for (int r = 0; r < ranks_; ++r) {
    starts[r] = total;
    total += sizes[r];
  }
  std::vector<char> all(rank_ == 0 ? total : 0);
  MPI_Gatherv(mine.data(), size, MPI_CHAR, all.data(), sizes.data(), starts.data(), MPI_CHAR, 0,
              comm_);
  return all;
}

}  // namespace monarch_flight
