// Kernels of the flow solver beside what the machine can do: triad bandwidth and dgemm rate.
// Counters: ns a cell; GB/s and GFLOP/s from bytes and operations a cell as docs/performance.md
// counts them. BENCH_CELLS sets the grid (default 0.65e6).
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "fluid/fields/projection.h"
#include "fluid/flow/flow.h"
#include "fluid/loads/wing_loads.h"
#include "fluid/pressure/blas.h"
#include "subject.h"

using namespace monarch_flight;
using namespace monarch_flight::fluid;

namespace {

double cellsWanted() {
  const char* text = std::getenv("BENCH_CELLS");
  return text ? std::atof(text) : 0.65e6;
}

/// Smooth fields of the size of a step's on the benchmarks' grid.
struct Fields {
  Grid grid;
  Slab slab;
  Layout layout;
  Velocity vn, vm, c, out;
  Array p, phi;
  Team team;
  momentum::Momentum momentum;
  PressureSolver pressure;
  momentum::MomentumStep step;
  WallVelocity wall;

  Fields(const Subject& s)
      : grid(s.grid(cellsWanted())),
        slab(grid.z.n()),
        layout(grid, slab),
        vn(layout),
        vm(layout),
        c(layout),
        out(layout),
        p(layout.size(), 0.0),
        phi(grid.cells() + grid.x.n() * grid.y.n(), 0.0),
        momentum(grid, layout, slab, team),
        pressure(grid, slab, team),
        step(s.dt(grid), s.dt(grid), s.air().mu / s.air().rho, s.air().rho),
        wall(wallVelocity(gridVelocity(s.motion(0)))) {
    for (int d = 0; d < 3; ++d) {
      for (std::size_t q = 0; q < vn.c[d].size(); ++q) {
        vn.c[d][q] = std::sin(1e-3 * q + d);
        vm.c[d][q] = std::sin(1e-3 * q + d + 0.01);
        c.c[d][q] = 2 * vn.c[d][q] - vm.c[d][q] + 1;
      }
    }
    momentum.prepare(step, {vn, vm, c, p, wall});
  }
  double* cells() { return phi.data() + grid.x.n() * grid.y.n(); }
  static Fields& get() {
    static Fields fields{Subject()};
    return fields;
  }
};

void count(benchmark::State& state, double cells, double bytes, double flops) {
  using benchmark::Counter;
  const double n = cells * state.iterations();
  state.counters["ns_per_cell"] = Counter(n * 1e-9, Counter::kIsRate | Counter::kInvert);
  state.counters["GB/s"] = Counter(n * bytes * 1e-9, Counter::kIsRate);
  state.counters["GFLOP/s"] = Counter(n * flops * 1e-9, Counter::kIsRate);
}

void triad(benchmark::State& state) {
  const std::size_t n = 16 << 20;  // three arrays of 128 MB
  Array a(n, 0.0), b(n, 1.0), c(n, 2.0);
  for (auto _ : state) {
    double* __restrict x = a.data();
    const double* __restrict y = b.data(), * __restrict z = c.data();
    for (std::size_t i = 0; i < n; ++i) x[i] = y[i] + 3.0 * z[i];
    benchmark::ClobberMemory();
  }
  count(state, n, 32, 2);  // with the line that a write reads first
}

void dgemm(benchmark::State& state) {
  const fluid::pressure::BlasUse blas;
  const int n = 768;
  Array a(n * n, 1.0), b(n * n, 2.0), c(n * n, 0.0);
  for (auto _ : state) {
    fluid::pressure::product(CblasNoTrans, CblasNoTrans, n, n, n, 1.0, a.data(), n, b.data(), n,
                             c.data(), n);
    benchmark::ClobberMemory();
  }
  count(state, double(n) * n, 0, 2.0 * n);
}

void rotation(benchmark::State& state) {
  Fields& f = Fields::get();
  Eigen::Matrix3d Q = Eigen::AngleAxisd(0.01, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  for (auto _ : state) rotateField(f.layout, f.team, Q, f.vn, f.out);
  count(state, f.grid.cells(), 120, 33);
}

void right_side_x_and_y_sweeps(benchmark::State& state) {
  Fields& f = Fields::get();
  for (auto _ : state) f.momentum.prepare(f.step, {f.vn, f.vm, f.c, f.p, f.wall});
  count(state, f.grid.cells(), 192, 330);
}

void z_sweep(benchmark::State& state) {
  Fields& f = Fields::get();
  for (auto _ : state) f.momentum.finish(f.vn, f.c, f.wall, f.out);
  count(state, f.grid.cells(), 120, 84);
}

void net_outflow(benchmark::State& state) {
  Fields& f = Fields::get();
  for (auto _ : state) netOutflow(f.grid, f.layout, f.team, f.vn, 1.0, f.cells());
  count(state, f.grid.cells(), 40, 10);
}

void pressureSolve(benchmark::State& state) {
  Fields& f = Fields::get();
  netOutflow(f.grid, f.layout, f.team, f.vn, 1.0, f.cells());
  const Array source = f.phi;
  for (auto _ : state) {
    state.PauseTiming();
    f.phi = source;
    state.ResumeTiming();
    f.pressure.solve(f.cells());
  }
  count(state, f.grid.cells(), 96, 2.0 * (f.grid.x.n() + f.grid.y.n()) + 20);
}

void projection(benchmark::State& state) {
  Fields& f = Fields::get();
  for (auto _ : state) subtractGradient(f.grid, f.layout, f.team, f.cells(), 1e-9, f.vn);
  count(state, f.grid.cells(), 56, 9);
}

void wingLoads(benchmark::State& state) {
  Fields& f = Fields::get();
  for (auto _ : state) {
    Loads l;
    loads::pressureLoads(f.grid, f.layout,
                         loads::WingPressure(f.grid, f.layout, f.p.data(), f.cells()), 1.2, f.wall,
                         l);
    loads::frictionLoads(f.grid, f.layout, f.momentum.metrics(), f.vn, f.cells(), 1.0, f.wall, 1e-5,
                         l);
    benchmark::DoNotOptimize(l);
  }
  count(state, f.grid.cells(), 0, 0);
}

}  // namespace

BENCHMARK(triad);
BENCHMARK(dgemm);
BENCHMARK(right_side_x_and_y_sweeps);
BENCHMARK(z_sweep);
BENCHMARK(rotation);
BENCHMARK(net_outflow);
BENCHMARK(pressureSolve)->Name("pressure");
BENCHMARK(projection);
BENCHMARK(wingLoads)->Name("loads");
BENCHMARK_MAIN();
