// Whole steps of the flow solver: time and memory per cell as one line of JSON. Under mpirun the
// grid is shared among the processes.
#include "fluid/flow/flow.h"

#include <mpi.h>
#include <sys/resource.h>

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "monarch_flight/coupling/step_model.h"
#include "monarch_flight/fluid/flow_cost.h"
#include "monarch_flight/fluid/processes.h"
#include "monarch_flight/run/federation.h"
#include "subject.h"

using namespace monarch_flight;
using namespace monarch_flight::fluid;

namespace {

double peakBytes() {
  rusage r;
  getrusage(RUSAGE_SELF, &r);
  return 1024.0 * r.ru_maxrss;
}

struct Sample {
  double cpu = 0, wall = 0;  // [s]
  Sample operator+(const Sample& o) const { return {cpu + o.cpu, wall + o.wall}; }
};

template <class Work>
Sample sample(Work work) {
  const double cpu = cpuSeconds(), wall = wallSeconds();
  work();
  return {cpuSeconds() - cpu, wallSeconds() - wall};
}

nlohmann::json nsPerCell(const std::vector<Sample>& samples, long cells) {
  std::vector<double> cpu, wall;
  for (const Sample& s : samples) {
    cpu.push_back(1e9 * s.cpu / cells);
    wall.push_back(1e9 * s.wall / cells);
  }
  return {{"best", best(cpu)},
          {"median", median(cpu)},
          {"wall_best", best(wall)},
          {"wall_median", median(wall)}};
}

/// Time of a sub-iteration that takes its loads from the affine operator instead of the flow: six
/// loads from twelve numbers, and the answers of flight and wing to them [s].
double operatorSeconds() {
  const Case c = loadCase("climb_printed", {}, CONFIG_DIR);
  const CoupledModel model = makeModel(c);
  StepModel step(model, c.coupling.length_scale);
  step.begin(c.motion->at(model.time(0)).interface(), c.motion->at(model.time(1)), 1);
  LoadOperator jacobian;
  jacobian.velocity.setRandom();
  jacobian.acceleration.setRandom();
  CouplingVector d = CouplingVector::Constant(1e-6);
  constexpr int kRepeats = 2000;
  double sum = 0;
  const double begin = cpuSeconds();
  for (int n = 0; n < kRepeats; ++n) {
    const AirMotion air = step.airMotion(Side::kRight, d);
    const Vector6d all =
        jacobian.velocity * air.velocity + jacobian.acceleration * air.acceleration;
    Loads loads;
    loads.force_pressure = 1e-6 * all.head<3>();
    loads.moment_pressure = 1e-6 * all.tail<3>();
    d[kX] += 1e-12 * step.residual(d, {loads, loads})[kZ];
    sum += d[kX];
  }
  const double seconds = (cpuSeconds() - begin) / kRepeats;
  if (!std::isfinite(sum)) throw std::runtime_error("bench_flow: the operator gave no numbers");
  return seconds;
}

nlohmann::json measure(NavierStokes& flow, const Subject& subject, int repeats) {
  constexpr int kWarmUp = 2;  // the first step is of first order
  std::vector<Sample> first, again, commit, full;
  long long sent = 0;
  KernelTimes profile{}, again_profile{};
  Loads loads;
  const double dt = subject.dt(flow.grid());
  flow.start(subject.motion(0), dt);
  for (int n = 1; n <= kWarmUp + repeats; ++n) {
    const WingMotion next = subject.motion(n * dt);
    const long long before = flow.slab().doublesSent();
    if (n == kWarmUp + 1) profile = flow.report().kernel_s;
    const Sample a = sample([&] { loads = flow.evaluate(next); });
    const KernelTimes once = flow.report().kernel_s;
    const long long between = flow.slab().doublesSent();
    const Sample b = sample([&] { flow.evaluate(next); });
    const long long after = flow.slab().doublesSent();
    const KernelTimes twice = flow.report().kernel_s;
    const Sample c = sample([&] { flow.commit(); });
    if (n <= kWarmUp) continue;
    for (std::size_t k = 0; k < kKernels; ++k) again_profile[k] += twice[k] - once[k];
    first.push_back(a), again.push_back(b), commit.push_back(c), full.push_back(a + c);
    sent += between - before + flow.slab().doublesSent() - after;
  }
  for (std::size_t k = 0; k < kKernels; ++k) profile[k] = flow.report().kernel_s[k] - profile[k];
  const long cells = flow.cells();
  // Of the solver's own profile, a step with one evaluation: the repeated ones are taken off. The
  // profile's wall times are shares of the computing time: a busy machine stretches all alike.
  nlohmann::json kernels;
  double wall = 0, cpu = 0;
  for (std::size_t k = 0; k < kKernels; ++k) wall += profile[k] - again_profile[k];
  for (const Sample& s : full) cpu += 1e9 * s.cpu / (repeats * double(cells));
  for (std::size_t k = 0; k < kKernels; ++k) {
    kernels[kKernelNames[k]] = cpu * (profile[k] - again_profile[k]) / wall;
  }
  return {{"kernel_ns", kernels},
          {"full_ns", nsPerCell(full, cells)},
          {"first_ns", nsPerCell(first, cells)},
          {"repeated_ns", nsPerCell(again, cells)},
          {"commit_ns", nsPerCell(commit, cells)},
          {"doubles_sent_per_step", sent / repeats},
          {"force", {loads.force().x(), loads.force().y(), loads.force().z()}},
          {"moment", {loads.moment().x(), loads.moment().y(), loads.moment().z()}}};
}

}  // namespace

int main(int argc, char** argv) {
  Processes processes(&argc, &argv);
  const double cells = argc > 1 ? std::atof(argv[1]) : 0, most = 1e8;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 10;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 1;
  if (!(cells >= 1e4 && cells <= most) || repeats < 1 || threads < 1) {
    std::cerr << "usage: bench_flow <cells, 1e4 to 1e8> [repeats, >= 1] [threads, >= 1]\n";
    return 2;
  }
  const Subject subject;
  const double memory_before = peakBytes(), begin = cpuSeconds();
  NavierStokes flow(subject.grid(cells), subject.air(), subject.chord(), kCourantLimit,
                    flowProcesses() > 1 ? MPI_COMM_WORLD : MPI_COMM_NULL, threads);
  const double setup = cpuSeconds() - begin;
  nlohmann::json result = measure(flow, subject, repeats);
  const Grid& g = flow.grid();
  result["operator_s"] = operatorSeconds();
  result["unknowns"] = capacitanceUnknowns(flow.grid());
  result["planned_setup_s"] = capacitanceSetup(capacitanceUnknowns(flow.grid()));
  result["planned_bytes_per_cell"] = flowMemory(flow.grid(), processes.count(), processes.count()) /
                                     static_cast<double>(flow.cells());
  result["cells"] = flow.cells();
  result["size"] = {g.x.n(), g.y.n(), g.z.n()};
  result["wing_faces"] = std::count(g.wing.begin(), g.wing.end(), 1);
  result["ranks"] = processes.count();
  result["threads"] = threads;
  result["setup_s"] = setup;
  result["bytes_per_cell"] =
      (peakBytes() - memory_before) * flow.slab().ranks() / static_cast<double>(flow.cells());
  result["courant"] = flow.report().courant;
  if (processes.rank() == 0) std::cout << std::setprecision(17) << result << std::endl;
  return 0;
}
