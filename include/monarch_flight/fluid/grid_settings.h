#pragma once
#include <string>
#include <vector>

namespace monarch_flight {

/// Sizes of the Navier-Stokes grid in mean chords; levels preview, standard, fine are presets of
/// it.
struct GridSettings {
  std::string level = "preview";  ///< preview | standard | fine | custom
  double cells_per_chord = 16;    ///< uniform in-plane resolution over the wing
  double first_cell = 0.03;       ///< height of the cells next to the wing [mean chords]
  double growth_plane = 1.2;      ///< stretching ratio outside the wing, in the wing's plane
  double growth_normal = 1.2;     ///< stretching ratio away from the wing
  double far_field = 10.0;        ///< distance from the wing to every outer boundary [mean chords]
  double margin = 0.3;            ///< uniform cells around the outline [mean chords]
  std::string outer = "rest";     ///< rest: v = 0 on the outer boundary; open: p = 0
  double courant_limit = 3.0;     ///< the run ends when a step's Courant number exceeds this
  static GridSettings preset(const std::string& level);  ///< throws InputError for an unknown level
  std::vector<std::string> problems() const;
};

}  // namespace monarch_flight
