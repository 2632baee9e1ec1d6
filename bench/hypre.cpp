// The same pressure system by hypre's conjugate gradients with BoomerAMG and by PressureSolver, in
// turns: seconds of each as one line of JSON.
#include <HYPRE.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "fluid/fields/field.h"
#include "monarch_flight/fluid/pressure_solver.h"
#include "subject.h"

using namespace monarch_flight;
using namespace monarch_flight::fluid;

namespace {

/// The negative of PressureSolver's operator (positive definite: the outer boundary is open).
HYPRE_IJMatrix assemble(const Grid& g) {
  const int nx = g.x.n(), ny = g.y.n(), nz = g.z.n(), n = nx * ny * nz;
  HYPRE_IJMatrix A;
  HYPRE_IJMatrixCreate(MPI_COMM_WORLD, 0, n - 1, 0, n - 1, &A);
  HYPRE_IJMatrixSetObjectType(A, HYPRE_PARCSR);
  HYPRE_IJMatrixInitialize(A);
  const int size[3] = {nx, ny, nz}, stride[3] = {1, nx, nx * ny};
  const Axis* axis[3] = {&g.x, &g.y, &g.z};
  for (int row = 0; row < n; ++row) {
    const int at[3] = {row % nx, row / nx % ny, row / (nx * ny)};
    int columns[7] = {row}, count = 1;
    double values[7] = {0};
    for (int d = 0; d < 3; ++d) {
      double area = 1;
      for (int e = 0; e < 3; ++e) area *= e == d ? 1.0 : axis[e]->width[at[e]];
      for (int side = 0; side < 2; ++side) {
        const int face = at[d] + side, other = at[d] + (side == 0 ? -1 : 1);
        int beyond[3] = {at[0], at[1], at[2]};
        beyond[d] = face;
        const bool outside = face == 0 || face == size[d];
        const double mobility = outside ? 1 : g.mobility.at(d, beyond[0], beyond[1], beyond[2]);
        if (mobility == 0) continue;
        const double conductance = mobility * area / axis[d]->gap[face];
        values[0] += conductance;
        if (other < 0 || other >= size[d]) continue;
        columns[count] = row + (other - at[d]) * stride[d];
        values[count++] = -conductance;
      }
    }
    HYPRE_IJMatrixSetValues(A, 1, &count, &row, columns, values);
  }
  HYPRE_IJMatrixAssemble(A);
  return A;
}

HYPRE_IJVector vectorOf(int n, const double* values) {
  HYPRE_IJVector v;
  HYPRE_IJVectorCreate(MPI_COMM_WORLD, 0, n - 1, &v);
  HYPRE_IJVectorSetObjectType(v, HYPRE_PARCSR);
  HYPRE_IJVectorInitialize(v);
  std::vector<int> rows(n);
  for (int i = 0; i < n; ++i) rows[i] = i;
  HYPRE_IJVectorSetValues(v, n, rows.data(), values);
  HYPRE_IJVectorAssemble(v);
  return v;
}

/// Solved once for each of `repeats`; the preconditioner is set up before and not counted.
struct Hypre {
  HYPRE_ParCSRMatrix A;
  HYPRE_Solver pcg, amg;
  int iterations = 0;
  double residual = 0;

  Hypre(const Grid& g, HYPRE_ParVector b, HYPRE_ParVector x) {
    HYPRE_IJMatrixGetObject(assemble(g), reinterpret_cast<void**>(&A));
    HYPRE_BoomerAMGCreate(&amg);
    HYPRE_BoomerAMGSetCoarsenType(amg, 8);  // PMIS, extended+i interpolation, strength 0.25:
    HYPRE_BoomerAMGSetInterpType(amg, 6);   // hypre's advice for three dimensions
    HYPRE_BoomerAMGSetStrongThreshold(amg, 0.25);
    HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
    HYPRE_BoomerAMGSetRelaxType(amg, 6);  // symmetric Gauss-Seidel
    HYPRE_BoomerAMGSetTol(amg, 0);
    HYPRE_BoomerAMGSetMaxIter(amg, 1);
    HYPRE_ParCSRPCGCreate(MPI_COMM_WORLD, &pcg);
    HYPRE_PCGSetTol(pcg, 1e-8);
    HYPRE_PCGSetMaxIter(pcg, 200);
    HYPRE_PCGSetTwoNorm(pcg, 1);
    HYPRE_PCGSetPrecond(pcg, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                        reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), amg);
    HYPRE_ParCSRPCGSetup(pcg, A, b, x);
  }
  void solve(HYPRE_ParVector b, HYPRE_ParVector x) {
    HYPRE_ParVectorSetConstantValues(x, 0.0);
    HYPRE_ParCSRPCGSolve(pcg, A, b, x);
    HYPRE_PCGGetNumIterations(pcg, &iterations);
    HYPRE_PCGGetFinalRelativeResidualNorm(pcg, &residual);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const double cells = argc > 1 ? std::atof(argv[1]) : 0.65e6;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 5;
  MPI_Init(&argc, &argv);
  HYPRE_Init();
  Grid grid = Subject().grid(cells);
  grid.open = true;
  const int n = static_cast<int>(grid.cells());
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Array source(n), ours(n);
  for (double& s : source) s = normal(random);
  HYPRE_ParVector b, x;
  HYPRE_IJVectorGetObject(vectorOf(n, source.data()), reinterpret_cast<void**>(&b));
  HYPRE_IJVector solution = vectorOf(n, ours.data());
  HYPRE_IJVectorGetObject(solution, reinterpret_cast<void**>(&x));
  const double begin = cpuSeconds();
  Hypre hypre(grid, b, x);
  const double hypre_setup = cpuSeconds() - begin;
  const PressureSolver direct(grid);

  std::vector<double> hypre_s, direct_s;
  for (int r = 0; r < repeats; ++r) {
    double t = cpuSeconds();
    hypre.solve(b, x);
    hypre_s.push_back(cpuSeconds() - t);
    for (int again = 0; again < 3; ++again) {
      ours = source;
      t = cpuSeconds();
      direct.solve(ours.data());
      direct_s.push_back(cpuSeconds() - t);
    }
  }
  std::vector<int> rows(n);
  for (int i = 0; i < n; ++i) rows[i] = i;
  std::vector<double> theirs(n);
  HYPRE_IJVectorGetValues(solution, n, rows.data(), theirs.data());
  double difference = 0, size = 0;  // the operators differ by their sign
  for (int i = 0; i < n; ++i) {
    difference += std::pow(theirs[i] + ours[i], 2);
    size += ours[i] * ours[i];
  }
  std::cout << nlohmann::json{{"cells", n},
                              {"hypre_s", median(hypre_s)},
                              {"hypre_setup_s", hypre_setup},
                              {"hypre_iterations", hypre.iterations},
                              {"hypre_residual", hypre.residual},
                              {"direct_s", median(direct_s)},
                              {"direct_setup_s", direct.setupSeconds()},
                              {"difference", std::sqrt(difference / size)}}
            << std::endl;
  MPI_Finalize();
  return 0;
}
