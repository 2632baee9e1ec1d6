#pragma once

namespace monarch_flight::fluid {

/// The threads of one process that work on a flow. What they do must not depend on who does it or
/// when: results then are the same bits for any number of threads.
class Team {
 public:
  explicit Team(int threads = 1) : threads_(threads) {}
  int threads() const { return threads_; }

  /// Calls work(index, thread) for every index in [begin, end), each by one of the threads. The
  /// work throws nothing.
  template <class Work>
  void each(int begin, int end, Work work) const {
    run(
        begin, end, [](void* w, int index, int thread) { (*static_cast<Work*>(w))(index, thread); },
        &work);
  }

 private:
  void run(int begin, int end, void (*work)(void*, int, int), void* context) const;
  int threads_;
};

}  // namespace monarch_flight::fluid
