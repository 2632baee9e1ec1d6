#include <algorithm>

#include "monarch_flight/fluid/fluid_model.h"

namespace monarch_flight {

FluidReport together(const FluidReport& a, const FluidReport& b) {
  FluidReport both = a;
  both.courant = std::max(a.courant, b.courant);
  both.divergence = std::max(a.divergence, b.divergence);
  both.cells = a.cells + b.cells;
  for (std::size_t i = 0; i < both.kernel_s.size(); ++i) both.kernel_s[i] += b.kernel_s[i];
  return both;
}

}  // namespace monarch_flight
