#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "monarch_flight/guidance/controller_settings.h"
#include "monarch_flight/guidance/wingbeat_guidance.h"
#include "monarch_flight/insect/numeric_table.h"

namespace monarch_flight {

/// Who prescribes the motion (docs/guidance.md).
enum class GuidanceKind {
  kMotion,      ///< the case's motion, a function of time
  kCommands,    ///< the same, led by what comes on the topic `command`
  kController,  ///< led by the built-in controller
  kNode,        ///< led, or replaced, by a node of one's own
  kReplay       ///< as in a recorded flight
};

/// As in a case.
const char* guidanceName(GuidanceKind kind);

/// guidance/limits and guidance/rates of defaults.yaml; the rates a flap. Throws InputError.
std::array<CommandLimits, kCommands> defaultCommandLimits(const std::string& config_dir);

struct GuidanceSettings {
  GuidanceKind kind = GuidanceKind::kMotion;
  WingbeatSettings wingbeat;                   ///< unless kMotion or kReplay
  std::optional<ControllerSettings> controller;  ///< of kController
  std::shared_ptr<const NumericTable> replay;  ///< ReplayGuidance::columns(), of kReplay
};

}  // namespace monarch_flight
