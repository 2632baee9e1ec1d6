#include "monarch_flight/fluid/grid_settings.h"

#include <sstream>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

void requireRange(std::vector<std::string>& faults, const char* key, double value, double low,
                  double high, const char* unit, const char* remedy) {
  if (value >= low && value <= high) return;  // false for NaN, which is a fault
  std::ostringstream text;
  text << "grid/" << key << " = " << value << unit << ": must be in [" << low << ", " << high
       << "]; " << remedy;
  faults.push_back(text.str());
}

}  // namespace

GridSettings GridSettings::preset(const std::string& level) {
  GridSettings s;
  s.level = level;
  if (level == "preview" || level == "custom") {
    s.cells_per_chord = 16;
    s.first_cell = 0.03;
    s.growth_plane = s.growth_normal = 1.3;
    s.margin = 0.25;
  } else if (level == "standard") {
    s.cells_per_chord = 28;
    s.first_cell = 0.02;
    s.growth_plane = s.growth_normal = 1.25;
    s.margin = 0.3;
  } else if (level == "fine") {
    s.cells_per_chord = 48;
    s.first_cell = 0.01;
    s.growth_plane = s.growth_normal = 1.2;
    s.margin = 0.4;
  } else {
    throw InputError("grid/level = \"" + level +
                     "\": must be preview, standard, fine or custom; choose one of these");
  }
  return s;
}

std::vector<std::string> GridSettings::problems() const {
  std::vector<std::string> faults;
  if (level != "preview" && level != "standard" && level != "fine" && level != "custom") {
    faults.push_back("grid/level = \"" + level +
                     "\": must be preview, standard, fine or custom; choose one of these");
  }
  requireRange(faults, "cells_per_chord", cells_per_chord, 4, 400, "",
               "16 is a preview, 28 the standard");
  requireRange(faults, "first_cell", first_cell, 1e-4, 0.5, " mean chords",
               "0.01 to 0.03 resolves the boundary layers");
  requireRange(faults, "growth_plane", growth_plane, 1.0, 1.5, "", "1.2 to 1.3 is usual");
  requireRange(faults, "growth_normal", growth_normal, 1.0, 1.5, "", "1.2 to 1.3 is usual");
  requireRange(faults, "far_field", far_field, 1.0, 1000.0, " mean chords",
               "10 keeps the domain-size error below a percent");
  requireRange(faults, "margin", margin, 0.0, 0.5 * far_field, " mean chords",
               "0.3 is usual, and it must lie well inside far_field");
  if (outer != "rest" && outer != "open") {
    faults.push_back("grid/outer = \"" + outer + "\": must be rest or open; choose one of these");
  }
  requireRange(faults, "courant_limit", courant_limit, 1e-3, 1e3, "", "3 is usual");
  return faults;
}

}  // namespace monarch_flight
