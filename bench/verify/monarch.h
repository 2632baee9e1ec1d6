#pragma once
#include <string>
#include <vector>

#include "monarch_flight/fluid/grid_settings.h"

namespace monarch_flight::verify {

/// Loads of both wings of the case tethered_fwuav at every step.
struct FlapSeries {
  std::vector<double> lift, thrust;  ///< upwards and forwards, inertial axes [N]
  std::vector<double> F_z, M_y;      ///< of one wing, wing axes [N, N m]
  std::vector<double> power;         ///< that the wings give to the air [W]
  double worst_courant = 0;
};

struct Quantity {
  const char* name;
  std::vector<double> FlapSeries::*series;
};
constexpr Quantity kQuantities[] = {{"lift", &FlapSeries::lift},
                                    {"thrust", &FlapSeries::thrust},
                                    {"pitch moment", &FlapSeries::M_y},
                                    {"power", &FlapSeries::power}};

/// Flies the case for so many flaps; results are kept for the length of the program.
const FlapSeries& monarchSeries(const GridSettings& grid, int steps_per_flap, int flaps);

}  // namespace monarch_flight::verify
