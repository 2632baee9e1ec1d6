// The added mass of plates, from the direct pressure solver, against exact values.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "monarch_flight/fluid/pressure_solver.h"

namespace monarch_flight {
namespace {

using Field = Eigen::VectorXd;

/// Generalised added mass [rho = 1] of the wing for the normal acceleration `shape`, from the
/// wall's pressures: the known normal gradient dp/dz = - rho a gives them from the cells'.
double addedMass(const Planform& wing, double cells_per_chord,
                 const std::function<double(double, double)>& shape) {
  GridSettings settings;
  settings.cells_per_chord = cells_per_chord;
  settings.first_cell = 0.5 / cells_per_chord;
  settings.growth_plane = settings.growth_normal = 1.2;
  const Grid g = makeGrid(wing, settings);
  const long plane = static_cast<long>(g.x.n()) * g.y.n(), up = g.k_wing * plane, down = up - plane;
  Field p = Field::Zero(g.cells());
  auto eachFace = [&](auto&& visit) {
    for (int j = 0; j < g.y.n(); ++j) {
      for (int i = 0; i < g.x.n(); ++i) {
        if (g.isWing(i, j)) {
          visit(static_cast<long>(j) * g.x.n() + i, g.x.width[i] * g.y.width[j],
                shape(g.x.centre[i], g.y.centre[j]));
        }
      }
    }
  };
  eachFace([&](long at, double area, double a) {
    p[down + at] +=
        area * a;  // the wall pushes air out of the cell above, draws it into the one below
    p[up + at] -= area * a;
  });
  PressureSolver(g).solve(p.data());
  const double half_heights = 0.5 * (g.z.width[g.k_wing] + g.z.width[g.k_wing - 1]);
  double m = 0;
  eachFace([&](long at, double area, double a) {
    m += area * a * (p[up + at] - p[down + at] + a * half_heights);
  });
  return m;
}

double one(double, double) { return 1.0; }

TEST(AddedMass, OfADiscBroadsideIsEightThirds) {
  const double exact = 8.0 / 3.0 * std::pow(0.5, 3), chord = M_PI / 4.0;  // diameter 1
  const Planform disc = Planform::ellipse(1.0, 1.0, 0.5, -0.5);
  EXPECT_NEAR(addedMass(disc, 12 * chord, one) / exact, 1.0, 0.04);
  EXPECT_NEAR(addedMass(disc, 24 * chord, one) / exact, 1.0, 0.02);
  EXPECT_NEAR(addedMass(disc, 48 * chord, one) / exact, 1.0, 0.012);
}

TEST(AddedMass, OfADiscAboutADiameterIsSixteenFortyFifths) {
  const double exact = 16.0 / 45.0 * std::pow(0.5, 5), chord = M_PI / 4.0;
  const Planform disc = Planform::ellipse(1.0, 1.0, 0.5, -0.5);
  for (bool about_x : {false, true}) {
    auto lever = [about_x](double x, double y) { return about_x ? y : x; };
    EXPECT_NEAR(addedMass(disc, 24 * chord, lever) / exact, 1.0, 0.03);
    EXPECT_NEAR(addedMass(disc, 48 * chord, lever) / exact, 1.0, 0.02);
  }
}

TEST(AddedMass, OfEllipsesMatchesLamb) {  // 4/3 pi rho a b^2 / E(e), semi-axes a > b
  for (double ratio : {2.0, 4.0}) {
    const double a = 0.5 * ratio, b = 0.5;
    const double exact =
        4.0 / 3.0 * M_PI * a * b * b / std::comp_ellint_2(std::sqrt(1 - b * b / (a * a)));
    const Planform ellipse = Planform::ellipse(1.0, ratio, 0.5, -0.5 * ratio);
    EXPECT_NEAR(addedMass(ellipse, 24 * ellipse.meanChord(), one) / exact, 1.0, 0.02) << ratio;
  }
}

TEST(AddedMass, OfRectanglesConvergesFasterThanAtFirstOrder) {
  nlohmann::json table;
  std::ifstream(TEST_DATA_DIR "/added_mass_rectangles.json") >> table;
  for (int ratio : {1, 2, 4}) {
    const auto& row = table.at("rect_AR" + std::to_string(ratio));
    const Planform plate = Planform::rectangle(1.0, ratio, 0.5, -0.5 * ratio);
    const struct {
      std::function<double(double, double)> shape;
      double exact, bound;  // at 24 cells a chord
    } cases[] = {{one, M_PI / 4 * ratio * row.at("C_heave").get<double>(), 0.02},
                 {[](double x, double) { return x; },
                  M_PI / 128 * ratio * row.at("C_pitch").get<double>(), 0.03},
                 {[](double, double y) { return y; }, row.at("I_roll").get<double>(), 0.03}};
    for (const auto& c : cases) {
      const double coarse = addedMass(plate, 12, c.shape) / c.exact - 1,
                   fine = addedMass(plate, 24, c.shape) / c.exact - 1;
      EXPECT_LT(std::abs(fine), c.bound) << ratio;
      EXPECT_LT(std::abs(fine), 0.45 * std::abs(coarse)) << ratio << " " << coarse << " " << fine;
    }
  }
}

// The far field at 10 chords: moving it out, or opening it, changes the added mass of a wing
// little.
TEST(AddedMass, HardlyFeelsTheOuterBoundary) {
  const Planform disc = Planform::ellipse(1.0, 1.0, 0.5, -0.5);
  GridSettings settings;
  auto heave = [&](double far, const char* outer) {
    settings.far_field = far;
    settings.outer = outer;
    const Grid g = makeGrid(disc, settings);
    const long plane = static_cast<long>(g.x.n()) * g.y.n(), up = g.k_wing * plane;
    Field p = Field::Zero(g.cells());
    for (long at = 0; at < plane; ++at) {
      if (!g.wing[at]) continue;
      const double area = g.x.width[at % g.x.n()] * g.y.width[at / g.x.n()];
      p[up - plane + at] += area;
      p[up + at] -= area;
    }
    PressureSolver(g).solve(p.data());
    double sum = 0.0;
    for (long at = 0; at < plane; ++at) {
      if (g.wing[at]) sum += p[up + at] - p[up - plane + at];
    }
    return sum;
  };
  const double far = heave(25, "rest");
  EXPECT_NEAR(heave(10, "rest") / far, 1.0, 1e-3);
  EXPECT_NEAR(heave(10, "open") / far, 1.0, 1e-3);
}

}  // namespace
}  // namespace monarch_flight
