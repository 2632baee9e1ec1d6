#pragma once

namespace monarch_flight {

/// The processes that mpirun started together, for as long as this object lives. A program that
/// mpirun did not start is alone, and MPI is never touched. One object a program, made first in
/// main.
///
/// Process 0 runs the program; all others call `serveFlow` and leave when it returns.
class Processes {
 public:
  Processes(int* argc, char*** argv);
  ~Processes();  ///< sends the others home (process 0) and ends MPI
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  /// Takes part in the flow solvers that process 0 makes, until it ends.
  void serveFlow() const;

 private:
  int rank_ = 0, count_ = 1;
};

/// Threads of each flow that is made in this process from now on; 0: all cores that it may use,
/// shared with the flow's other processes here and with `flows` at a time. Results do not depend on
/// it.
void setFlowThreads(int threads);
int flowThreads(int here, int flows);

/// Processes that makeNavierStokes will share its grid among.
int flowProcesses();
/// As many of them as share the memory of this machine, counted when `Processes` was made.
int flowProcessesHere();

}  // namespace monarch_flight
