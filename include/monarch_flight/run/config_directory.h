#pragma once
#include <string>

namespace monarch_flight {

/// The config folder of the prefix, devel space or installed, that holds this library, whoever
/// calls: `<prefix>/share/monarch_flight/config`, where this library is in `<prefix>/lib` or, by
/// Debian's custom, in `<prefix>/lib/<machine>`. Throws InputError where it is missing.
std::string configDirectory();

}  // namespace monarch_flight
