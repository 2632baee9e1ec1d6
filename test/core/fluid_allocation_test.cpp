// Nothing is allocated inside a step of the flow solver.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "fluid/flow/flow.h"

// Counts every request for memory of the process (glibc), but for OpenBLAS' own: on processors with
// AVX-512 its kernels for small products take their buffers from malloc.
namespace {
long g_requests = 0;

void count(void* caller) {
  Dl_info from;
  const bool known = dladdr(caller, &from) != 0 && from.dli_fname != nullptr;
  if (!known || std::strstr(from.dli_fname, "openblas") == nullptr) ++g_requests;
}
}  // namespace
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* old, std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);
extern "C" void* malloc(std::size_t size) {
  count(__builtin_return_address(0));
  return __libc_malloc(size);
}
extern "C" void* calloc(std::size_t n, std::size_t size) {
  count(__builtin_return_address(0));
  return __libc_calloc(n, size);
}
extern "C" void* realloc(void* old, std::size_t size) {
  count(__builtin_return_address(0));
  return __libc_realloc(old, size);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count(__builtin_return_address(0));
  return __libc_memalign(alignment, size);
}

namespace monarch_flight::fluid {
namespace {

WingMotion gliding(double t) {
  WingMotion m;
  m.v_W = Eigen::Vector3d(0.5, 0.1, -0.2 + 0.1 * t);
  m.a_W = Eigen::Vector3d(0, 0, 0.1);
  return m;
}

class Steps : public ::testing::TestWithParam<const char*> {};

TEST_P(Steps, AllocateNothing) {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = 8;
  s.first_cell = 0.06;
  s.far_field = 4;
  s.outer = GetParam();
  Air air;
  air.mu = 0.012;
  const double dt = 0.01;
  NavierStokes flow(makeGrid(Planform::ellipse(1.0, 2.0, 0.3), s), air, 1.0, 10.0);
  flow.start(gliding(0), dt);
  flow.evaluate(gliding(dt));  // BLAS takes its buffers in the first call
  flow.commit();
  const long before = g_requests;
  for (int n = 2; n <= 4; ++n) {
    flow.evaluate(gliding(n * dt + 0.001));
    flow.evaluate(gliding(n * dt));
    flow.commit();
  }
  EXPECT_EQ(g_requests - before, 0);
  const auto one = std::make_unique<std::vector<double>>(100);
  EXPECT_GE(g_requests - before, 2) << "the counter does not count";
  EXPECT_EQ(one->size(), 100u);
}

INSTANTIATE_TEST_SUITE_P(OuterBoundary, Steps, ::testing::Values("rest", "open"));

}  // namespace
}  // namespace monarch_flight::fluid
