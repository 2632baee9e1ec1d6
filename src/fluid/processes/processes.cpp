#include "monarch_flight/fluid/processes.h"

#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "fluid/processes/peer_watch.h"
#include "fluid/processes/shared_flow.h"
#include "fluid/processes/time_limit.h"

namespace monarch_flight {
namespace {

constexpr double kTogether = 60.0;  // limit of beginning and ending together [s]

bool startedByMpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

bool running() {
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  if (begun) MPI_Finalized(&ended);
  return begun && !ended;
}

int processes_here = 1;
int threads_wanted = 0;  // of each flow; 0: as many as there are cores

}  // namespace

Processes::Processes(int* argc, char*** argv) {
  if (!startedByMpirun()) return;
  const fluid::processes::TimeLimit limit(kTogether,
                                          "the processes of the flow did not all begin within " +
                                              std::to_string(static_cast<int>(kTogether)) + " s");
  int level = 0;  // other threads never call MPI
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm here;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &processes_here);
  MPI_Comm_free(&here);
  fluid::processes::PeerWatch::begin(MPI_COMM_WORLD);
}

Processes::~Processes() {
  if (!running()) return;
  if (rank_ == 0 && count_ > 1) fluid::processes::SharedFlow::dismiss(MPI_COMM_WORLD);
  fluid::processes::PeerWatch::limit(kTogether);
  {
    const fluid::processes::PeerWait wait(fluid::processes::WatchSlot::kEverybody);
    MPI_Finalize();
  }
  fluid::processes::PeerWatch::end();
}

void Processes::serveFlow() const { fluid::processes::SharedFlow::serve(MPI_COMM_WORLD); }

void setFlowThreads(int threads) { threads_wanted = threads; }

int flowThreads(int here, int flows) {
  if (threads_wanted > 0) return threads_wanted;
  return std::max(1, omp_get_max_threads() / (here * flows));
}

int flowProcessesHere() { return processes_here; }

int flowProcesses() {
  int count = 1;
  if (running()) MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

}  // namespace monarch_flight
