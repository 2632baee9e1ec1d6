// Added mass and inertia of flat plates, 24 cells across the shorter side, and their convergence.
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "monarch_flight/math/errors.h"
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

/// Elements of the added mass about the root [rho = 1].
struct Exact {
  double heave, pitch, roll, coupling;  ///< M_zz, about y, about x, M(F_z, alpha_y)
};

/// Ellipse of chord 1 (x) and span b (y) about its centre: Lamb's ellipsoid without thickness.
Exact ellipse(double span) {
  const double a = 0.5, b = 0.5 * span;
  const int n = 400;  // periodic integrands: the trapezoidal rule is exact to rounding
  double alpha = 0, beta = 0, perimeter = 0;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n, c = std::cos(angle), s = std::sin(angle);
    const double root = std::sqrt(a * a * c * c + b * b * s * s);
    alpha += a * b * c * c / (root * root * root) * M_PI / n;
    beta += a / b * c * c / root * M_PI / n;
    perimeter += root * 2 * M_PI / n;
  }
  const double heave = 16.0 / 3 * M_PI * a * a * b * b / perimeter;
  const double inertia = 8 * M_PI / 15 * a * b;
  return {heave, inertia * a * a / (2 * alpha + beta), inertia * b * b / (alpha + 2 * beta), 0};
}

Exact rectangle(int ratio, double hinge) {
  std::ifstream in(VERIFY_DATA_DIR "/added_mass_rectangles.json");
  if (!in) throw InputError("cannot read " VERIFY_DATA_DIR "/added_mass_rectangles.json");
  const auto row = nlohmann::json::parse(in).at("rect_AR" + std::to_string(ratio));
  const double m = M_PI / 4 * ratio * row.at("C_heave").get<double>(), middle = hinge - 0.5;
  return {m, M_PI / 128 * ratio * row.at("C_pitch").get<double>() + m * middle * middle,
          row.at("I_roll").get<double>(), -m * middle};
}

struct Shape {
  const char* name;
  Planform planform;
  Exact exact;
};

Matrix6d computed(const Planform& planform, double cells_across) {
  GridSettings s = GridSettings::preset("standard");
  s.level = "custom";
  s.cells_per_chord = cells_across * planform.meanChord();  // the shorter side is 1
  s.first_cell = 0.56 / s.cells_per_chord;                  // as in all presets
  return makeNavierStokes(planform, airOf(1, 1e-3), s)->addedMass();
}

/// On 12, 24 and (curved outlines) 48 cells across the shorter side. An order is asked for where
/// the outline lies on grid lines; that of a staircase scatters with its corners.
void compare(Report& report, const Shape& shape, bool curved) {
  const std::vector<double> cells =
      curved ? std::vector<double>{12, 24, 48} : std::vector<double>{12, 24};
  std::vector<Matrix6d> m;
  for (double n : cells) m.push_back(computed(shape.planform, n));
  const struct {
    const char* name;
    int row, column;
    double exact, bound;
  } elements[] = {{"heave", 2, 2, shape.exact.heave, 0.02},
                  {"pitch", 4, 4, shape.exact.pitch, 0.03},
                  {"roll", 3, 3, shape.exact.roll, 0.03},
                  {"heave-pitch", 2, 4, shape.exact.coupling, 0.03}};
  for (const auto& e : elements) {
    if (e.exact == 0) continue;
    const std::string name = std::string(shape.name) + ": " + e.name;
    std::vector<double> error;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double value = m[i](e.row, e.column);
      error.push_back(std::abs(value / e.exact - 1));
      if (i > 0) report.near(name, text("%g cells across", cells[i]), value, e.exact, e.bound);
    }
    report.curve({"added_mass", "cells across the shorter side", "relative error", name, cells,
                  error, true});
    if (!curved)
      report.order(name + ", order", "12, 24 cells", std::log2(error[0] / error[1]), 1.5);
  }
}

}  // namespace

void addedMass(Report& report) {
  compare(report, {"disc", Planform::ellipse(1, 1, 0.5, -0.5), ellipse(1)}, true);
  compare(report, {"ellipse 2:1", Planform::ellipse(1, 2, 0.5, -1), ellipse(2)}, true);
  compare(report, {"ellipse 3:1", Planform::ellipse(1, 3, 0.5, -1.5), ellipse(3)}, true);
  for (int ratio : {1, 2, 4}) {
    const std::string name = "rectangle AR " + std::to_string(ratio);
    compare(report,
            {name.c_str(), Planform::rectangle(1, ratio, 0.5, -0.5 * ratio), rectangle(ratio, 0.5)},
            false);
  }
  compare(report, {"AR 2, hinge at 0.25", Planform::rectangle(1, 2, 0.25, -1), rectangle(2, 0.25)},
          false);
}

}  // namespace monarch_flight::verify
