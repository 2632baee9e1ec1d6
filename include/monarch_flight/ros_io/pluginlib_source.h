#pragma once

namespace monarch_flight {

/// Flow models and guidance that packages export for this one are found and loaded by pluginlib
/// from now on (run/plugins.h). Looks for none until a case names one; libraries stay until the
/// end.
void usePluginlib();

}  // namespace monarch_flight
