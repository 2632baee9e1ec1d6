#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/insect/planform.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// What a fluid plugin makes its model from. References hold for the call alone.
struct FluidPluginInput {
  const Case& flown;         ///< all of the run; its air is flown.air
  Side side;                 ///< of the wing; the left one is told as its mirror image (state.h)
  const Planform& planform;  ///< of that wing
  std::string parameters;    ///< fluid/parameters of the case as YAML; "{}": it has none
};

/// A flow model of another package (docs/extending.md), named in the case: fluid/solver.
class FluidPlugin {
 public:
  virtual ~FluidPlugin() = default;
  /// The air of one wing; what takes time belongs into its `start`. Throws what a person should
  /// read where that cannot be.
  virtual std::unique_ptr<FluidModel> make(const FluidPluginInput& input) = 0;
};

/// What a guidance plugin makes its guidance from. The reference holds for the call alone.
struct GuidancePluginInput {
  const Case& flown;       ///< all of the run: flown.motion, flown.wind, flown.time ...
  std::string parameters;  ///< guidance/parameters of the case as YAML; "{}": it has none
};

/// Guidance of another package, named in the case: guidance/type.
class GuidancePlugin {
 public:
  virtual ~GuidancePlugin() = default;
  /// Who prescribes the motion. Throws what a person should read where that cannot be.
  virtual std::unique_ptr<Guidance> make(const GuidancePluginInput& input) = 0;
};

/// Where plugins of one kind come from. Both throw std::exception.
template <class Plugin>
struct PluginSource {
  std::function<std::vector<std::string>()> known;
  std::function<std::shared_ptr<Plugin>(const std::string& name)> load;
};

struct PluginSources {
  PluginSource<FluidPlugin> fluids;
  PluginSource<GuidancePlugin> guidances;
};

/// Where this program takes plugins from; without it a case that names one cannot be flown, only
/// read. To be called before any of the following.
void setPluginSources(PluginSources sources);

/// Makes once, and drops, what plugins make of the case: before anything is written. Throws
/// InputError with all that is unknown, cannot be loaded or is refused.
void requirePlugins(const Case& c);
/// The same for its fluid, for its guidance alone.
void requireFluidPlugin(const Case& c);
void requireGuidancePlugin(const Case& c);

/// The model of a case whose fluid is a plugin. Throws InputError.
std::unique_ptr<FluidModel> fluidByPlugin(const Case& c, Side side);
/// Of a case whose guidance is one. Throws InputError.
std::unique_ptr<Guidance> guidanceByPlugin(const Case& c);

}  // namespace monarch_flight
