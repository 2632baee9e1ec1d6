// The words of a case for its air and its guidance.
#include "monarch_flight/run/case.h"

namespace monarch_flight {

std::string fluidName(const Case& c) {
  if (c.fluid == FluidKind::kPlugin) return c.fluid_plugin.name;
  return c.fluid == FluidKind::kQuasiSteady ? "quasi_steady" : "navier_stokes";
}

const char* guidanceName(GuidanceKind kind) {
  switch (kind) {
    case GuidanceKind::kMotion:
      return "motion";
    case GuidanceKind::kCommands:
      return "commands";
    case GuidanceKind::kController:
      return "controller";
    case GuidanceKind::kNode:
      return "node";
    case GuidanceKind::kReplay:
      return "replay";
    case GuidanceKind::kPlugin:
      break;
  }
  return "";
}

std::string guidanceName(const GuidanceSettings& settings) {
  return settings.kind == GuidanceKind::kPlugin ? settings.plugin.name
                                                : guidanceName(settings.kind);
}

}  // namespace monarch_flight
