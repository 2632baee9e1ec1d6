#include "monarch_flight/run/plugins.h"

#include <algorithm>
#include <utility>

#include "monarch_flight/math/errors.h"
#include "run/words.h"

namespace monarch_flight {
namespace {

/// A plugin as the case has it.
struct Named {
  std::string section;  // of the case
  std::string key;
  const PluginChoice& choice;
  std::string fault(const std::string& text) const {
    return section + "/" + key + " = " + choice.name + ": " + text;
  }
};

PluginSources& sources() {
  static PluginSources all;
  return all;
}

Named fluidOf(const Case& c) { return {"fluid", "solver", c.fluid_plugin}; }
Named guidanceOf(const Case& c) { return {"guidance", "type", c.guidance.plugin}; }

template <class Plugin>
std::shared_ptr<Plugin> load(const PluginSource<Plugin>& source, const Named& named) {
  if (!source.load)
    throw InputError(
        named.fault("is a plugin, which this program cannot load; fly the case with "
                    "monarch fly, or choose one of this package"));
  try {
    const std::vector<std::string> known = source.known();
    if (std::find(known.begin(), known.end(), named.choice.name) == known.end())
      throw InputError(named.fault(
          "there is no such plugin: known are " + (known.empty() ? "none" : joined(known)) +
          "; correct the name, or build its package, source the setup.bash of that workspace, and "
          "see that its package.xml exports it (docs/extending.md)"));
    return source.load(named.choice.name);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(named.fault(std::string("the plugin cannot be loaded: ") + e.what() +
                                 "; build its package again, and source its setup.bash"));
  }
}

template <class Plugin, class Input>
auto make(Plugin& plugin, const Named& named, const Input& input) {
  const std::string remedy = "; correct " + named.section + "/parameters, or the plugin";
  decltype(plugin.make(input)) made;
  try {
    made = plugin.make(input);
  } catch (const std::exception& e) {
    throw InputError(
        named.fault(std::string("the plugin makes nothing of this case: ") + e.what() + remedy));
  }
  if (!made) throw InputError(named.fault("the plugin makes nothing of this case" + remedy));
  return made;
}

}  // namespace

void setPluginSources(PluginSources all) { sources() = std::move(all); }

void requireFluidPlugin(const Case& c) {
  if (c.fluid != FluidKind::kPlugin) return;
  for (Side side : c.sides()) fluidByPlugin(c, side);
}

void requireGuidancePlugin(const Case& c) {
  if (c.guidance.kind == GuidanceKind::kPlugin) guidanceByPlugin(c);
}

void requirePlugins(const Case& c) {
  std::vector<std::string> faults;
  for (const auto require : {requireFluidPlugin, requireGuidancePlugin}) {
    try {
      require(c);
    } catch (const InputError& e) {
      faults.push_back(e.what());
    }
  }
  if (!faults.empty()) throw InputError(faults);
}

std::unique_ptr<FluidModel> fluidByPlugin(const Case& c, Side side) {
  const Named named = fluidOf(c);
  const FluidPluginInput input{c, side, c.insect.wings[side].planform, named.choice.parameters};
  return make(*load(sources().fluids, named), named, input);
}

std::unique_ptr<Guidance> guidanceByPlugin(const Case& c) {
  const Named named = guidanceOf(c);
  return make(*load(sources().guidances, named), named,
              GuidancePluginInput{c, named.choice.parameters});
}

}  // namespace monarch_flight
