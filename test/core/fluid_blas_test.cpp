// BLAS' work buffers are taken once, where a failure can be told.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fluid/pressure/blas.h"
#include "fluid/pressure/modes.h"

namespace monarch_flight::fluid::pressure {
namespace {

constexpr long kMegabyte = 1L << 20;

/// Address space of this process [bytes].
long addressSpace() {
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * 4096;
}

/// Lets this process grow by `bytes` and no further.
void limitMemory(long bytes) {
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max = static_cast<rlim_t>(addressSpace() + bytes);
  setrlimit(RLIMIT_AS, &limit);
}

/// Work for which OpenBLAS needs a buffer.
void work() {
  std::vector<double> faces;
  for (int i = 0; i <= 200; ++i) faces.push_back(i * (1.0 + 0.01 * i));
  const AxisModes modes(Axis::fromFaces(faces), true);
  ASSERT_EQ(modes.n(), 200);
}

[[noreturn]] void takeWith(long bytes) {
  limitMemory(bytes);
  try {
    takeBlasBuffers();
  } catch (const std::runtime_error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    std::exit(1);
  }
  std::fprintf(stderr, "taken\n");
  std::exit(0);
}

using Blas = ::testing::Test;
using BlasDeathTest = ::testing::Test;

// First, while nothing is taken: a process of its own each.
TEST(BlasDeathTest, WithoutMemoryItSaysWhatIsNeeded) {
  EXPECT_EXIT(takeWith(20 * kMegabyte), ::testing::ExitedWithCode(1),
              "no memory for BLAS: its [0-9]+ work buffer.*ulimit -v");
  EXPECT_EXIT(takeWith(4096 * kMegabyte), ::testing::ExitedWithCode(0), "taken");
}

TEST(Blas, BuffersOfUsesAtATimeAreKept) {
  { const BlasUse one, two, three; }
  const long taken = addressSpace();
  {
    const BlasUse again, and_again;
    const BlasUse thrice;
    EXPECT_EQ(addressSpace(), taken);
  }
  const BlasUse a, b, c;
  auto fourth = std::make_unique<BlasUse>();
  EXPECT_GE(addressSpace() - taken, 100 * kMegabyte);
}

TEST(BlasDeathTest, LaterWorkNeedsNoMoreMemory) {
  takeBlasBuffers();
  EXPECT_EXIT(
      {
        limitMemory(20 * kMegabyte);
        work();
        std::exit(0);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace monarch_flight::fluid::pressure
