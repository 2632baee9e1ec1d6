// The direct pressure solve with a wing: residual of the full operator, and the divergence left
// after a step.
#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "fluid/fields/projection.h"
#include "monarch_flight/fluid/pressure_solver.h"
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {

using namespace fluid;

void directSolve(Report& report) {
  for (const char* outer : {"rest", "open"}) {
    GridSettings s = GridSettings::preset("preview");
    s.outer = outer;
    const Grid grid = makeGrid(Planform::ellipse(1, 3, 0.3), s);
    const std::string resolution = std::string(outer) + text(", %.2f M cells", 1e-6 * grid.cells());
    {
      const PressureSolver solver(grid);
      std::mt19937 engine(1);
      std::normal_distribution<double> normal;
      Eigen::VectorXd b(grid.cells()), back(grid.cells());
      for (double& v : b) v = normal(engine);
      if (!grid.open) b.array() -= b.mean();
      Eigen::VectorXd p = b;
      solver.solve(p.data());
      solver.apply(p.data(), back.data());
      report.below("residual of the operator", resolution, (back - b).norm() / b.norm(), 1e-10);
    }
    NavierStokes flow(grid, airOf(1.2, 0.012), 1, kNoCourantLimit);
    auto motion = [](double t) {
      return flapAndPitch(oscillation(0.5, 2 * M_PI, t), oscillation(0.4, 2 * M_PI, t, 1));
    };
    fly(flow, motion, 0.005, 5);
    report.below("divergence after 5 steps", resolution,
                 relativeDivergence(grid, flow.layout(), flow.velocity()), 1e-10);
  }
}

}  // namespace monarch_flight::verify
