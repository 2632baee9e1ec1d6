// Writes mesh and motion of the peer's case: the same grid and wing as bench_flow's as an OpenFOAM
// polyMesh with a baffle, and the flap as a table of rigid motion.
#include <cstdlib>
#include <iostream>

#include "poly_mesh.h"
#include "subject.h"

using namespace monarch_flight;

int main(int argc, char** argv) {
  const double cells = argc > 2 ? std::atof(argv[1]) : 0;
  if (!(cells >= 1e4 && cells <= 1e8)) {
    std::cerr << "usage: bench_openfoam_case <cells, 1e4 to 1e8> <folder of the case>\n";
    return 2;
  }
  const std::string folder = argv[2];
  const Subject subject;
  const Grid grid = subject.grid(cells);
  PolyMesh(grid).write(folder + "/constant/polyMesh");
  writeMotion([&](double t) { return subject.motion(t); }, subject.dt(grid), 500,
              folder + "/constant/motion.dat");
  std::cout << grid.cells() << ' ' << std::setprecision(15) << subject.dt(grid) << std::endl;
  return 0;
}
