// Process 1 alone has no memory for its part of the flow, or (argument "blas") for BLAS' buffers:
// all end at once, with its reason. Run by mpirun with 2 processes; what must be said stands in
// cmake/tests.cmake.
#include <mpi.h>
#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "fluid/pressure/blas.h"
#include "fluid/processes/shared_flow.h"

using namespace monarch_flight;
using namespace monarch_flight::fluid;

namespace {

/// Lets this process grow by `bytes` and no further.
void limitMemory(long bytes) {
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max = static_cast<rlim_t>(pages * 4096 + bytes);
  setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const bool blas = argc > 1 && std::string(argv[1]) == "blas";
  if (rank == 1) {
    if (!blas)
      pressure::takeBlasBuffers();  // the limit is to strike behind them, on every processor
    limitMemory(20L << 20);
    processes::SharedFlow::serve(MPI_COMM_WORLD);
  } else {
    const Grid grid =
        makeGrid(Planform::rectangle(1.0, 2.0, 0.5), GridSettings::preset("standard"));
    processes::SharedFlow flow(grid, Air(), 1.0, 3.0, MPI_COMM_WORLD);
    flow.start(WingMotion(), 0.01);
    flow.evaluate(WingMotion());
    std::puts("the flow was made nevertheless");
    processes::SharedFlow::dismiss(MPI_COMM_WORLD);
  }
  MPI_Finalize();
  return 0;
}
