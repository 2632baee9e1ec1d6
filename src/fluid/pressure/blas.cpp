#include "fluid/pressure/blas.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

/// OpenBLAS' own; absent (null) with another BLAS, which has no such buffers.
extern "C" {
void openblas_set_num_threads(int threads) __attribute__((weak));
int openblas_get_num_threads() __attribute__((weak));
void* blas_memory_alloc(int level) __attribute__((weak));
void blas_memory_free(void* buffer) __attribute__((weak));
}

namespace monarch_flight::fluid::pressure {
namespace {

constexpr std::size_t kBuffer = 128UL << 20;  // one of OpenBLAS 0.3.21, on every amd64 [bytes]
constexpr int kForEveryThread = 20000;        // elements of a vector that all its threads share

std::mutex guard;            // of the three below
int uses = 0, taken = 0;     // of BLAS now; the most at a time so far, for which there are buffers
bool workers_ready = false;  // OpenBLAS' threads have theirs

/// OpenBLAS waits for its threads when the program ends, and one without a buffer asks for ever.
void leaveAtOnce(int status, void*) {
  std::fflush(nullptr);
  std::cout.flush();
  _exit(status);
}

/// Throws unless this many buffers can be had.
void requireBuffers(int count, int workers) {
  const std::size_t bytes = kBuffer * static_cast<std::size_t>(count);
  void* room = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room != MAP_FAILED) {
    munmap(room, bytes);
    return;
  }
  std::string text = "no memory for BLAS: its " + std::to_string(count) + " work buffer(s) need " +
                     std::to_string(bytes >> 20) +
                     " MB of address space, which this process may not have; raise its limit "
                     "(ulimit -v; vm.overcommit_memory of the system)";
  if (workers > 0) {
    text += ", or set OPENBLAS_NUM_THREADS=1";
    on_exit(leaveAtOnce, nullptr);
  }
  throw std::runtime_error(text);
}

/// Its threads ask for their buffers by themselves; done when all of them have done some work.
void awaitWorkers() {
  const std::vector<double> x(kForEveryThread, 0.0);
  std::vector<double> y(x);
  cblas_daxpy(kForEveryThread, 1.0, x.data(), 1, y.data(), 1);
}

/// Makes OpenBLAS have `count` buffers besides those of its threads.
void take(int count) {
  const int workers = workers_ready ? 0 : openblas_get_num_threads() - 1;
  requireBuffers(count + workers, workers);
  if (workers > 0) awaitWorkers();
  workers_ready = true;
  std::vector<void*> held(static_cast<std::size_t>(count));
  for (void*& buffer : held) buffer = blas_memory_alloc(0);
  for (void* buffer : held) blas_memory_free(buffer);
}

}  // namespace

BlasUse::BlasUse(int threads) : threads_(threads) {
  const std::lock_guard<std::mutex> lock(guard);
  if (blas_memory_alloc != nullptr && uses + threads_ > taken) {
    take(uses + threads_);
    taken = uses + threads_;
  }
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  uses += threads_;
}

BlasUse::~BlasUse() {
  const std::lock_guard<std::mutex> lock(guard);
  uses -= threads_;
}

}  // namespace monarch_flight::fluid::pressure
