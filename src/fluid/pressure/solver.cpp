#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "fluid/fields/field.h"
#include "fluid/fields/slab.h"
#include "fluid/pressure/blas.h"
#include "fluid/pressure/capacitance.h"
#include "fluid/pressure/columns.h"
#include "fluid/pressure/modes.h"
#include "fluid/pressure/transform.h"
#include "monarch_flight/fluid/pressure_solver.h"

namespace monarch_flight {

using fluid::Slab;
using fluid::Team;
using namespace fluid::pressure;

namespace {

/// Faces of the wing. Throws std::invalid_argument, on every process alike, when they close the
/// whole plane of a closed box.
int facesOf(const Grid& g) {
  const auto count = std::count(g.wing.begin(), g.wing.end(), 1);
  if (!g.open && static_cast<std::size_t>(count) == g.wing.size()) {
    throw std::invalid_argument("PressureSolver: the wing closes the whole plane of a closed box");
  }
  return static_cast<int>(count);
}

}  // namespace

struct PressureSolver::Impl {
  Impl(const Grid& g, const Slab& s, const Team& team)
      : blas(team.threads()),
        grid(g),
        slab(s),
        x(g.x, g.open),
        y(g.y, g.open),
        transform(x, y, slab.planes(), team),
        columns(g, slab, x, y, transform.blocks(), team),
        faces(facesOf(g)),
        wing(columns.touchesWing()
                 ? std::make_unique<WingCapacitance>(g, s, x, y, columns.wingResponse(), team)
                 : nullptr),
        spectrum(static_cast<std::size_t>(x.n()) * y.n() * slab.planes()),
        down(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(x.n()) * y.n())),
        up(down) {}

  const BlasUse blas;  // first: before anything else is taken
  const Grid grid;
  const Slab slab;
  const AxisModes x, y;
  const PlaneTransform transform;
  const PressureColumns columns;
  const int faces;
  const std::unique_ptr<const WingCapacitance> wing;  ///< only where its plane is touched
  fluid::Array spectrum;                              // scratch
  Eigen::VectorXd down, up;
  bool incomplete = false;  ///< the spectrum is solved as far as the wing's plane
  double setup_seconds = 0.0;
};

PressureSolver::PressureSolver(const Grid& grid) : PressureSolver(grid, Slab(grid.z.n()), Team()) {}

PressureSolver::PressureSolver(const Grid& grid, const Slab& slab, const Team& team) {
  const auto begin = std::chrono::steady_clock::now();
  impl_ = std::make_unique<Impl>(grid, slab, team);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  impl_->setup_seconds = spent.count();
}

PressureSolver::~PressureSolver() = default;

// 1. modes of x and y; 2. z from both ends to the wing's plane; 3. the wing's answer to the
// pressures there (by the one or two processes that touch the plane); 4. modes to cells of the two
// planes there.
void PressureSolver::solveAtWing(double* b_to_p, KernelTimes& times) const {
  impl_->incomplete = true;
  LapTimer timer(times);
  double* spectrum = impl_->spectrum.data();
  impl_->transform.forwardNegative(b_to_p, spectrum);
  timer.lap(Kernel::kTransforms);
  if (!impl_->grid.open) impl_->columns.removeMean(spectrum);
  impl_->columns.eliminate(spectrum);
  impl_->columns.meet(spectrum);
  timer.lap(Kernel::kColumns);
  if (impl_->wing && !impl_->wing->empty()) {
    double* down = impl_->down.data();
    double* up = impl_->up.data();
    impl_->columns.wingPressures(down, up);
    impl_->wing->answer(down, up);
    impl_->columns.addSources(down, up);
  }
  timer.lap(Kernel::kCapacitance);
  impl_->columns.solveAtWing(spectrum);
  timer.lap(Kernel::kColumns);
  const Slab& slab = impl_->slab;
  const int below = std::max(slab.k0(), impl_->grid.k_wing - 1);
  const int above = std::min(slab.k1(), impl_->grid.k_wing + 1);
  impl_->transform.inverse(spectrum, b_to_p, below - slab.k0(), above - slab.k0());
  timer.lap(Kernel::kTransforms);
}

// z back outwards from the wing's plane; modes to cells.
void PressureSolver::complete(double* p, KernelTimes& times) const {
  if (!impl_->incomplete) throw std::logic_error("PressureSolver::complete without solveAtWing");
  impl_->incomplete = false;
  LapTimer timer(times);
  double* spectrum = impl_->spectrum.data();
  impl_->columns.substitute(spectrum);
  if (!impl_->grid.open) impl_->columns.centre(spectrum);
  timer.lap(Kernel::kColumns);
  impl_->transform.inverse(spectrum, p, 0, impl_->slab.planes());
  timer.lap(Kernel::kTransforms);
}

void PressureSolver::solve(double* b_to_p) const {
  KernelTimes nobody_asks{};
  solveAtWing(b_to_p, nobody_asks);
  complete(b_to_p, nobody_asks);
}

void PressureSolver::apply(const double* p, double* y) const {
  const Grid& g = impl_->grid;
  const int nx = g.x.n(), ny = g.y.n(), nz = g.z.n();
  const std::ptrdiff_t row = nx, plane = static_cast<std::ptrdiff_t>(nx) * ny;
  std::fill(y, y + plane * nz, 0.0);
  // Flux from cell c - step to cell c through the face in front of c, n cells along the line.
  auto sweep = [&](std::ptrdiff_t c, std::ptrdiff_t step, const Axis& axis, double area,
                   const auto& mobility) {
    if (g.open) y[c] -= area / axis.gap.front() * p[c];
    for (int i = 1; i < axis.n(); ++i) {
      c += step;
      const double flux = mobility(i) * area / axis.gap[i] * (p[c - step] - p[c]);
      y[c] += flux;
      y[c - step] -= flux;
    }
    if (g.open) y[c] -= area / axis.gap.back() * p[c];
  };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j)
      sweep(k * plane + j * row, 1, g.x, g.y.width[j] * g.z.width[k],
            [&](int i) { return g.mobility.at(0, i, j, k); });
    for (int i = 0; i < nx; ++i)
      sweep(k * plane + i, row, g.y, g.x.width[i] * g.z.width[k],
            [&](int j) { return g.mobility.at(1, i, j, k); });
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      sweep(j * row + i, plane, g.z, g.x.width[i] * g.y.width[j],
            [&](int k) { return g.mobility.at(2, i, j, k); });
    }
  }
}

int PressureSolver::wingFaces() const { return impl_->faces; }
double PressureSolver::setupSeconds() const { return impl_->setup_seconds; }

}  // namespace monarch_flight
