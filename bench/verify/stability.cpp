// Three flaps of the monarch on the preview and the standard grid, 500 and 1000 steps each.
#include "monarch_flight/math/errors.h"
#include "verify/monarch.h"
#include "verify/setup.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {

void stability(Report& report) {
  for (const char* level : {"preview", "standard"}) {
    for (int steps : {500, 1000}) {
      const std::string resolution = std::string(level) + text(", %g steps, 3 flaps", steps);
      try {
        const FlapSeries& s = monarchSeries(GridSettings::preset(level), steps, 3);
        report.below("alternation of F_z", resolution, alternation(s.F_z, steps / 10), 1e-4);
        report.below("alternation of M_y", resolution, alternation(s.M_y, steps / 10), 1e-4);
        report.state("largest Courant number", resolution, s.worst_courant, 0);
      } catch (const NumericalError& e) {
        report.below(std::string("ended: ") + e.what(), resolution, HUGE_VAL, 1e-4);
      }
    }
  }
}

}  // namespace monarch_flight::verify
