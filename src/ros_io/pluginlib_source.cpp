#include "monarch_flight/ros_io/pluginlib_source.h"

#include <pluginlib/class_loader.hpp>
#include <string>

#include "monarch_flight/run/plugins.h"

namespace monarch_flight {
namespace {

/// `base`: the class's full name, as plugin descriptions have it.
template <class Plugin>
PluginSource<Plugin> sourceOf(const char* base) {
  // Never deleted: what a plugin has made needs its library.
  const auto loader = [base]() -> pluginlib::ClassLoader<Plugin>& {
    static auto* const one = new pluginlib::ClassLoader<Plugin>("monarch_flight", base);
    return *one;
  };
  PluginSource<Plugin> source;
  source.known = [loader] { return loader().getDeclaredClasses(); };
  source.load = [loader](const std::string& name) {
    return std::shared_ptr<Plugin>(loader().createUniqueInstance(name));
  };
  return source;
}

}  // namespace

void usePluginlib() {
  setPluginSources({sourceOf<FluidPlugin>("monarch_flight::FluidPlugin"),
                    sourceOf<GuidancePlugin>("monarch_flight::GuidancePlugin")});
}

}  // namespace monarch_flight
