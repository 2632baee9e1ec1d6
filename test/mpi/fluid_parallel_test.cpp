// The flow on several processes against the flow on one. Run by mpirun with 1 to 4 processes.
#include <gtest/gtest.h>
#include <mpi.h>

#include "fluid/processes/shared_flow.h"
#include "monarch_flight/fluid/flow_cost.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::fluid {
namespace {

WingMotion flapping(double t) {
  const double w = 2 * M_PI, phi = 0.5 * std::sin(w * t), rate = 0.5 * w * std::cos(w * t);
  WingMotion m;
  m.R_IW = rotationX(phi) * rotationY(0.4);
  m.omega_W = rotationY(0.4).transpose() * Eigen::Vector3d(rate, 0, 0);
  m.v_W = m.R_IW.transpose() * Eigen::Vector3d(0.5, 0.1, -0.2);
  return m;
}

enum class Outer { kRest, kOpen, kRestClose };  ///< the last: few planes below the wing

Grid plate(Outer outer) {
  GridSettings s = GridSettings::preset("preview");
  s.cells_per_chord = 6;
  s.first_cell = 0.08;
  s.far_field = 3;
  s.outer = outer == Outer::kOpen ? "open" : "rest";
  Grid grid = makeGrid(Planform::ellipse(1.0, 2.0, 0.3), s);
  if (outer != Outer::kRestClose) return grid;
  const int below = 3;
  const std::vector<double>& z = grid.z.face;
  return makeGrid(grid.x, grid.y, Axis::fromFaces({z.begin() + grid.k_wing - below, z.end()}),
                  below, false, grid.wing);
}

Air thinAir() {
  Air air;
  air.rho = 1.2;
  air.mu = 0.012;
  return air;
}

std::vector<double> fly(NavierStokes& flow, int steps) {
  std::vector<double> loads;
  const double dt = 0.01;
  flow.start(flapping(0), dt);
  for (int n = 1; n <= steps; ++n) {
    flow.evaluate(flapping(n * dt + 0.001));  // a sub-iteration that is not kept
    const Loads l = flow.evaluate(flapping(n * dt));
    flow.commit();
    for (const Eigen::Vector3d& v :
         {l.force_pressure, l.force_friction, l.moment_pressure, l.moment_friction}) {
      loads.insert(loads.end(), v.data(), v.data() + 3);
    }
  }
  return loads;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0, scale = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::abs(a[i] - b[i]));
    scale = std::max(scale, std::abs(b[i]));
  }
  return worst / scale;
}

class Processes : public ::testing::TestWithParam<Outer> {};

TEST_P(Processes, GiveTheSameLoads) {
  NavierStokes alone(plate(GetParam()), thinAir(), 1.0, 10.0);
  NavierStokes together(plate(GetParam()), thinAir(), 1.0, 10.0, MPI_COMM_WORLD);
  EXPECT_LT((alone.addedMass() - together.addedMass()).norm(), 1e-12 * alone.addedMass().norm());
  const std::vector<double> one = fly(alone, 8), all = fly(together, 8);
  EXPECT_LT(difference(all, one), 1e-10);
  EXPECT_NEAR(together.report().courant, alone.report().courant, 1e-10);
  EXPECT_EQ(fly(together, 8), all);  // repeatable bit for bit
}

/// What docs/scaling.md says that this process sends in a step of one evaluation [doubles].
long long sentInAStep(const Layout& l, const Slab& slab, int k_wing, long unknowns) {
  const long long m = l.sz, n = static_cast<long long>(l.nx) * l.ny;
  const int below = !slab.atBottom(), above = !slab.atTop(), neighbours = below + above;
  const bool under = l.k0<k_wing, over = l.k1> k_wing;
  const int inwards = (under && l.k1 <= k_wing && above) || (over && l.k0 >= k_wing && below);
  const int outwards = (under && below) + (over && above);
  const long long halo = (6 + 1 + 4) * neighbours * m + above * n;  // old levels; w; commit; phi
  const long long z_factor = 3 * (2 * inwards + outwards) * m;
  const bool shares_wing = l.k0 == k_wing || l.k1 == k_wing;
  const long long pressure = (inwards + outwards) * n + (shares_wing ? unknowns : 0);
  return halo + z_factor + pressure;
}

TEST_P(Processes, SendWhatTheScalingModelSays) {
  NavierStokes flow(plate(GetParam()), thinAir(), 1.0, 10.0, MPI_COMM_WORLD);
  fly(flow, 2);
  const int kw = flow.grid().k_wing;
  if (flow.slab().ranks() == 2 && GetParam() != Outer::kRestClose) {
    EXPECT_TRUE(flow.layout().k0 == kw || flow.layout().k1 == kw);  // each keeps half of its matrix
  }
  const double dt = 0.01;
  const long long before = flow.slab().doublesSent();
  flow.evaluate(flapping(3 * dt));
  flow.commit();
  EXPECT_EQ(
      sentInAStep(flow.layout(), flow.slab(), flow.grid().k_wing, capacitanceUnknowns(flow.grid())),
      flow.slab().doublesSent() - before);
}

TEST_P(Processes, GatherTheWholeFlow) {
  NavierStokes alone(plate(GetParam()), thinAir(), 1.0, 10.0);
  NavierStokes together(plate(GetParam()), thinAir(), 1.0, 10.0, MPI_COMM_WORLD);
  fly(alone, 3);
  fly(together, 3);
  const auto one = alone.flowField(), all = together.flowField();
  if (together.slab().rank() != 0) return;
  ASSERT_EQ(one->cells(), all->cells());
  ASSERT_EQ(one->wing.size(), all->wing.size());
  for (auto part :
       {&FlowField::velocity, &FlowField::vorticity, &FlowField::pressure, &FlowField::q}) {
    const std::vector<float>&a = (*one).*part, &b = (*all).*part;
    ASSERT_EQ(a.size(), b.size());
    float largest = 0, apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, std::abs(a[i]));
      apart = std::max(apart, std::abs(a[i] - b[i]));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(apart, 1e-6 * largest);
  }
  float friction = 0, apart = 0;
  for (std::size_t i = 0; i < one->wing.size(); ++i) {
    const auto &a = one->wing[i], &b = all->wing[i];
    friction = std::max(friction, std::abs(a.friction_upper[0]));
    apart = std::max(apart, std::abs(a.friction_upper[0] - b.friction_upper[0]));
    EXPECT_NEAR(a.p_lower, b.p_lower, 1e-5 * std::abs(a.p_lower));
  }
  EXPECT_LT(apart, 1e-6 * friction);
}

TEST_P(Processes, SaveAndRestoreBitwise) {
  NavierStokes flow(plate(GetParam()), thinAir(), 1.0, 10.0, MPI_COMM_WORLD);
  fly(flow, 3);
  std::vector<char> state = flow.save();
  long size = static_cast<long>(state.size());
  MPI_Bcast(&size, 1, MPI_LONG, 0, MPI_COMM_WORLD);
  state.resize(size);
  MPI_Bcast(state.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
  const Loads first = flow.evaluate(flapping(0.04));
  flow.commit();
  flow.restore(state);
  EXPECT_EQ(first.force(), flow.evaluate(flapping(0.04)).force());
}

TEST(Slab, GathersInPieces) {
  int count = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const Slab slab(MPI_COMM_WORLD, 2 * count);
  const std::vector<char> mine(10 + static_cast<std::size_t>(rank), static_cast<char>('a' + rank));
  std::string expected;
  for (int r = 0; r < count; ++r) expected += std::string(10 + r, static_cast<char>('a' + r));
  for (const std::size_t piece : {std::size_t{3}, std::size_t{10}, std::size_t{1000}}) {
    const std::vector<char> all = slab.gather(mine, piece);
    EXPECT_EQ(std::string(all.begin(), all.end()), rank == 0 ? expected : "");
  }
}

TEST(Slab, RefusesTooManyProcesses) {
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  EXPECT_THROW(Slab(MPI_COMM_WORLD, 2 * count - 1), InputError);
  EXPECT_EQ(Slab(MPI_COMM_WORLD, 2 * count).planes(), 2);
}

INSTANTIATE_TEST_SUITE_P(Boundary, Processes,
                         ::testing::Values(Outer::kRest, Outer::kOpen, Outer::kRestClose));

/// But for the rounding of the flows and of the whole numbers.
bool samePicture(const FlowPicture& a, const FlowPicture& b) {
  bool same = !a.empty() && a.origin == b.origin && a.size == b.size &&
              std::abs(a.step - b.step) < 1e-5f * a.step;
  for (std::size_t n = 0; same && n < a.points(); ++n)
    same = std::abs(a.q_root[n] - b.q_root[n]) < 2 && std::abs(a.omega_y[n] - b.omega_y[n]) < 2;
  return same;
}

/// Process 0 flies, the others serve: what the fluid node does.
bool sharedFlowFlies() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) {
    processes::SharedFlow::serve(MPI_COMM_WORLD);
    return true;
  }
  NavierStokes alone(plate(Outer::kRest), thinAir(), 1.0, 10.0);
  processes::SharedFlow shared(plate(Outer::kRest), thinAir(), 1.0, 10.0, MPI_COMM_WORLD);
  alone.start(flapping(0), 0.01);
  shared.start(flapping(0), 0.01);
  double worst = 0;
  std::vector<char> state;
  for (int n = 1; n <= 4; ++n) {
    const Loads a = alone.evaluate(flapping(n * 0.01)), b = shared.evaluate(flapping(n * 0.01));
    worst = std::max(worst, (a.force() - b.force()).norm() / a.force().norm());
    alone.commit();
    shared.commit();
    state = shared.save();
  }
  const bool pictures =
      shared.surfacePressure().facets.size() == alone.surfacePressure().facets.size() &&
      samePicture(shared.flowPicture(5000), alone.flowPicture(5000)) &&
      shared.flowField()->cells() == alone.flowField()->cells();
  const Eigen::Vector3d force = shared.evaluate(flapping(0.05)).force();
  shared.restore(state);
  const bool same = shared.evaluate(flapping(0.05)).force() == force;
  processes::SharedFlow::dismiss(MPI_COMM_WORLD);
  std::printf("shared flow: difference %g, restored %d, pictures %d\n", worst, same, pictures);
  return worst < 1e-10 && same && pictures;
}

}  // namespace
}  // namespace monarch_flight::fluid

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  int failed = RUN_ALL_TESTS();
  if (!monarch_flight::fluid::sharedFlowFlies()) failed = 1;
  MPI_Finalize();
  return failed;
}
