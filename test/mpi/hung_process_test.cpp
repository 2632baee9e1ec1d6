// A process of the flow that hangs ends them all, by name, within the limit of a wait. Run by
// mpirun with a way to hang; what must be said stands in cmake/tests.cmake.
#include <mpi.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fluid/processes/peer_watch.h"
#include "fluid/processes/shared_flow.h"
#include "fluid/processes/time_limit.h"

using namespace monarch_flight;
using namespace monarch_flight::fluid;

namespace {

constexpr double kWatchdog = 5.0;  // [s]

void hang(int = 0) {
  while (true) pause();
}

GridSettings small() {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = 6;
  s.far_field = 3;
  return s;
}

/// Process 0: flies, lets `fall` happen, and flies on.
template <class Fall>
void lead(Fall fall) {
  const Grid grid = makeGrid(Planform::rectangle(1.0, 2.0, 0.5), small());
  processes::SharedFlow flow(grid, Air(), 1.0, 3.0, MPI_COMM_WORLD, kWatchdog);
  flow.start(WingMotion(), 0.01);
  flow.evaluate(WingMotion());
  std::puts("flying");
  std::fflush(stdout);
  fall();
  while (true) flow.evaluate(WingMotion());
}

/// Process 0: sends the others home, from where the last one does not come back, and begins anew.
void leadTwice() {
  const Grid grid = makeGrid(Planform::rectangle(1.0, 2.0, 0.5), small());
  processes::SharedFlow(grid, Air(), 1.0, 3.0, MPI_COMM_WORLD, kWatchdog);
  processes::SharedFlow::dismiss(MPI_COMM_WORLD);
  processes::SharedFlow(grid, Air(), 1.0, 3.0, MPI_COMM_WORLD,
                        kWatchdog / 10);  // waits ten times as long
  std::puts("the flow was made nevertheless");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string way = argc > 1 ? argv[1] : "";
  const char* variable = std::getenv("OMPI_COMM_WORLD_RANK");
  if (way == "before" && variable != nullptr && std::string(variable) == "1") hang();
  {
    const processes::TimeLimit limit(way == "before" ? 2.0 : 60.0, "not all began");
    MPI_Init(&argc, &argv);
  }
  int rank = 0, count = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  processes::PeerWatch::begin(MPI_COMM_WORLD);
  const int last = count - 1;
  int pid = getpid();
  MPI_Bcast(&pid, 1, MPI_INT, last, MPI_COMM_WORLD);
  if (rank > 0) {
    std::signal(SIGUSR1, hang);
    processes::SharedFlow::serve(MPI_COMM_WORLD);
    if (rank == last) hang();
    processes::SharedFlow::serve(MPI_COMM_WORLD);
  } else if (way == "stopped") {
    lead([&] { kill(pid, SIGSTOP); });
  } else if (way == "in_a_wait") {
    lead([&] { kill(pid, SIGUSR1); });
  } else if (way == "computing") {
    leadTwice();
  } else if (way == "caller_stopped") {
    lead([] { raise(SIGSTOP); });
  }
  return 0;
}
