#pragma once
#include <mpi.h>

#include <memory>
#include <vector>

namespace monarch_flight::fluid {

/// The part of the grid that one process owns: the planes [k0, k1) of cells, and of z-faces
/// likewise (the last process owns the outer face nz too). One process owns everything and never
/// calls MPI. Every operation is collective over the processes that it names and repeatable bit for
/// bit at a fixed number of processes.
class Slab {
 public:
  /// All of `planes` on one process.
  explicit Slab(int planes) : k0_(0), k1_(planes) {}
  /// An even share of `planes` for this process of `comm`. Throws InputError when a process would
  /// own fewer than two planes.
  Slab(MPI_Comm comm, int planes);

  int k0() const { return k0_; }
  int k1() const { return k1_; }
  int planes() const { return k1_ - k0_; }
  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  bool owns(int k) const { return k >= k0_ && k < k1_; }
  bool atBottom() const { return rank_ == 0; }
  bool atTop() const { return rank_ == ranks_ - 1; }

  void sendUp(const double* data, int n) const { send(data, n, rank_ + 1); }
  void sendDown(const double* data, int n) const { send(data, n, rank_ - 1); }
  void receiveFromAbove(double* data, int n) const { receive(data, n, rank_ + 1); }
  void receiveFromBelow(double* data, int n) const { receive(data, n, rank_ - 1); }
  /// `mine` to the process above (below), its data into `other`.
  void exchangeAbove(const double* mine, double* other, int n) const {
    exchange(mine, other, n, rank_ + 1);
  }
  void exchangeBelow(const double* mine, double* other, int n) const {
    exchange(mine, other, n, rank_ - 1);
  }
  /// Fills the two neighbouring planes of a field: `at(k)` is the first of the `n` doubles of plane
  /// k.
  template <class At>
  void fillHalo(At at, int n) const {
    if (ranks_ == 1) return;
    shift(at(k1_ - 1), at(k0_ - 1), n, +1);
    shift(at(k0_), at(k1_), n, -1);
  }
  void sum(double* values, int n) const;
  double max(double value) const;
  /// The bytes of all processes one after the other, on process 0; elsewhere empty. They are sent
  /// in pieces of `piece` bytes: MPI counts by int.
  std::vector<char> gather(const std::vector<char>& mine, std::size_t piece = 1u << 30) const;
  /// Doubles sent by this process so far through this slab and its copies, for the scaling model.
  long long doublesSent() const { return *sent_; }

 private:
  void send(const double* data, int n, int to) const;
  void receive(double* data, int n, int from) const;
  void exchange(const double* mine, double* other, int n, int with) const;
  void shift(const double* out, double* in, int n, int direction) const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, ranks_ = 1;
  int k0_, k1_;
  std::shared_ptr<long long> sent_ = std::make_shared<long long>(0);  // of all copies together
};

}  // namespace monarch_flight::fluid
