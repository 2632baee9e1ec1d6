// A heaving and a flapping plate: our flow solver's normal force at each step and its computing
// time as one line of JSON, or the same grid and motion as a case of OpenFOAM.
#include <cstdlib>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "fluid/flow/flow.h"
#include "poly_mesh.h"
#include "subject.h"
#include "verify/setup.h"

using namespace monarch_flight;
using verify::oscillation;

namespace {

constexpr double kOmega = 2 * M_PI, kEnd = 0.5;  // period 1; chord 1, span 2, density 1
constexpr double kCore = 0.25, kFar = 4;         // uniform cells beside the plate; outer boundary
constexpr double kHeight = 0.6;                  // of the first cell by a cell of the core

// Strokes from rest to rest: velocity begins at 0, acceleration at once.
WingMotion heaving(double t) {
  const Eigen::Vector3d z = oscillation(0.3, kOmega, t, M_PI / 2);
  WingMotion m = verify::flapAndPitch(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                      {0, 0, z[1]}, {0, 0, z[2]});
  m.r_I = {0, 0, z[0]};
  return m;
}

/// Pitches up to mid-stroke and back, 0.6 sin^2(w t).
WingMotion flapping(double t) {
  const Eigen::Vector3d pitch = oscillation(-0.3, 2 * kOmega, t, M_PI / 2);
  return verify::flapAndPitch(oscillation(0.6, kOmega, t, M_PI / 2),
                              pitch + Eigen::Vector3d(0.3, 0, 0));
}

struct Plate {
  double lead, root;  ///< of the rectangle 1 by 2, wing axes
  double viscosity;   ///< Reynolds number of mid span at its fastest: 94 and 113
  WingMotion (*motion)(double t);
};
const std::map<std::string, Plate> kPlates = {{"heaving", {0.3, -1, 0.02, heaving}},
                                              {"flapping", {0.3, 0.5, 0.05, flapping}}};

/// Rate of (e^(rate s) - 1) / rate, which begins as s, to be `length` at s = 1.
double growth(double length) {
  double low = 1e-3, high = 20;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::expm1(middle) / middle > length ? high : low) = middle;
  }
  return low;
}

/// Grids of one family: the faces of one with n cells a chord are among those of one with 2 n.
Axis axis(double middle, double core, double first, double far, double cells) {
  const double rate = growth((far - core) / first);
  const int n = static_cast<int>(std::lround((core + 1) * cells));
  std::vector<double> face(2 * n + 1, middle);
  for (int i = 1; i <= n; ++i) {
    const double s = i / cells - core;  // beyond the core, 0 to 1
    const double r = s <= 1e-9 ? i / cells : core + first * std::expm1(rate * s) / rate;
    face[n + i] += r, face[n - i] -= r;
  }
  return Axis::fromFaces(face);
}

Grid gridOf(const Plate& plate, double cells) {
  const double x_middle = plate.lead - 0.5, y_middle = plate.root + 1;
  Axis x = axis(x_middle, 0.5 + kCore, 1, 0.5 + kFar, cells);
  Axis y = axis(y_middle, 1 + kCore, 1, 1 + kFar, cells), z = axis(0, 0, kHeight, kFar, cells);
  std::vector<std::uint8_t> wing;
  for (double v : y.centre) {
    for (double u : x.centre)
      wing.push_back(std::abs(u - x_middle) < 0.5 && std::abs(v - y_middle) < 1);
  }
  const int k_wing = z.n() / 2;
  return makeGrid(std::move(x), std::move(y), std::move(z), k_wing, true, std::move(wing));
}

nlohmann::json fly(const Plate& plate, Grid grid, double dt, int steps) {
  Air air;
  air.rho = 1, air.mu = plate.viscosity;
  const double begin = cpuSeconds();
  fluid::NavierStokes flow(std::move(grid), air, 1, kCourantLimit);
  flow.start(plate.motion(0), dt);
  const double setup = cpuSeconds() - begin;
  std::vector<double> time, force;
  double courant = 0;
  for (int n = 1; n <= steps; ++n) {
    time.push_back(n * dt);
    force.push_back(flow.evaluate(plate.motion(n * dt)).force().z());
    flow.commit();
    courant = std::max(courant, flow.report().courant);
  }
  return {{"t", time},        {"force", force},     {"cpu_s", cpuSeconds() - begin},
          {"setup_s", setup}, {"courant", courant}, {"cells", flow.cells()}};
}

}  // namespace

int main(int argc, char** argv) {
  const auto plate = argc > 3 ? kPlates.find(argv[1]) : kPlates.end();
  const int cells = argc > 3 ? std::atoi(argv[2]) : 0, steps = argc > 3 ? std::atoi(argv[3]) : 0;
  if (plate == kPlates.end() || cells < 4 || cells > 64 || cells % 4 || steps < 1) {
    std::cerr << "usage: bench_plate heaving|flapping <cells a chord, 4, 8, ... 64> <steps, >= 1> "
                 "[folder of a case of OpenFOAM]\n";
    return 2;
  }
  Grid grid = gridOf(plate->second, cells);
  const double dt = kEnd / steps;
  if (argc > 4) {
    const std::string folder = argv[4];
    PolyMesh(grid).write(folder + "/constant/polyMesh");
    writeMotion(plate->second.motion, dt, steps + 1, folder + "/constant/motion.dat");
    std::cout << nlohmann::json{{"cells", grid.cells()},
                                {"dt", dt},
                                {"nu", plate->second.viscosity}}
              << std::endl;
  } else {
    std::cout << fly(plate->second, std::move(grid), dt, steps) << std::endl;
  }
  return 0;
}
