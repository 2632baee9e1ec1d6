// What a flow computes does not depend on how many threads compute it.
#include <gtest/gtest.h>

#include "fluid/flow/flow.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::fluid {
namespace {

using Eigen::Vector3d;

WingMotion flapping(double t) {
  const Vector3d axis = Vector3d(0.9, -0.3, 0.2).normalized();
  WingMotion m;
  m.R_IW = expSO3(axis * (4 * t + 10 * t * t));
  m.omega_W = axis * (4 + 20 * t);
  m.alpha_W = axis * 20;
  m.v_W = Vector3d(0.6, 0.05, 0.2 + 0.3 * t);
  m.a_W = Vector3d(0, 0, 0.3);
  return m;
}

constexpr int kSteps = 20;

struct Flown {
  std::vector<Loads> loads, guessed;
  std::vector<char> state;
};

/// `guesses`: each step is evaluated for another motion first.
Flown flown(int threads, bool open, bool guesses = true) {
  GridSettings s = GridSettings::preset("preview");
  s.level = "custom";
  s.cells_per_chord = 8;
  s.first_cell = 0.06;
  s.far_field = 4;
  Grid grid = makeGrid(Planform::rectangle(0.02, 0.05, 0.25), s);
  grid.open = open;
  const Air air;
  NavierStokes flow(grid, air, 0.02, 10.0, MPI_COMM_NULL, threads);
  constexpr double kDt = 2e-4;
  flow.start(flapping(0), kDt);
  Flown result;
  for (int n = 1; n <= kSteps; ++n) {
    if (guesses) result.guessed.push_back(flow.evaluate(flapping((n + 0.2) * kDt)));
    result.loads.push_back(flow.evaluate(flapping(n * kDt)));
    flow.commit();
  }
  result.state = flow.save();
  return result;
}

void expectEqual(const std::vector<Loads>& a, const std::vector<Loads>& b, int threads) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].force(), b[n].force()) << threads;
    EXPECT_EQ(a[n].moment(), b[n].moment()) << threads;
  }
}

class Threads : public ::testing::TestWithParam<bool> {};

TEST_P(Threads, GiveTheSameBits) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "ThreadSanitizer does not see how threads of OpenMP wait for each other";
#endif
  const Flown alone = flown(1, GetParam());
  for (int threads : {2, 3, 4}) {
    const Flown together = flown(threads, GetParam());
    expectEqual(alone.loads, together.loads, threads);
    expectEqual(alone.guessed, together.guessed, threads);
    EXPECT_TRUE(alone.state == together.state) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(ClosedAndOpen, Threads, ::testing::Bool());

/// Lines that do not see the wall are not solved again within a step: as if all were.
TEST(RepeatedEvaluation, IsTheFirstOne) {
  const Flown once = flown(1, false, false), again = flown(1, false, true);
  expectEqual(once.loads, again.loads, 1);
  EXPECT_TRUE(once.state == again.state);
}

}  // namespace
}  // namespace monarch_flight::fluid
