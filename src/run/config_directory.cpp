#include "monarch_flight/run/config_directory.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

// Of this library, links followed.
fs::path libraryFile() {
  Dl_info place;
  static const int here = 0;
  std::error_code none;
  return dladdr(&here, &place) != 0 ? fs::weakly_canonical(place.dli_fname, none) : fs::path();
}

}  // namespace

std::string configDirectory() {
  const fs::path library = libraryFile();
  std::error_code none;
  for (fs::path place = library.parent_path(); place.has_relative_path();
       place = place.parent_path()) {
    const fs::path found = place / "share/monarch_flight/config";
    if (fs::is_directory(found, none)) return found;
  }
  throw InputError("no configuration: there is no share/monarch_flight/config above " +
                   library.string() + "; build or install the package again");
}

}  // namespace monarch_flight
