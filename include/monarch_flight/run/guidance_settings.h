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
  kReplay,      ///< as in a recorded flight
  kPlugin       ///< by guidance of another package (run/plugins.h)
};

/// A plugin as a case names it.
struct PluginChoice {
  std::string name;        ///< package/Name
  std::string parameters;  ///< its section of the case, as YAML
};

struct GuidanceSettings;
/// As guidance/type has it.
std::string guidanceName(const GuidanceSettings& settings);
/// The same; "" of a plugin.
const char* guidanceName(GuidanceKind kind);

/// guidance/limits and guidance/rates of defaults.yaml; the rates a flap. Throws InputError.
std::array<CommandLimits, kCommands> defaultCommandLimits(const std::string& config_dir);

struct GuidanceSettings {
  GuidanceKind kind = GuidanceKind::kMotion;
  WingbeatSettings wingbeat;                     ///< unless kMotion, kReplay or kPlugin
  std::optional<ControllerSettings> controller;  ///< of kController
  std::shared_ptr<const NumericTable> replay;    ///< ReplayGuidance::columns(), of kReplay
  PluginChoice plugin;                           ///< of kPlugin
};

}  // namespace monarch_flight
