#pragma once
#include <string>

namespace monarch_flight {

/// The config folder of the prefix, devel space or installed, that holds this library: whoever calls,
/// <prefix>/share/monarch_flight/config beside <prefix>/lib. Throws InputError where it is missing.
std::string configDirectory();

}  // namespace monarch_flight
