#pragma once
#include <yaml-cpp/yaml.h>

#include <string>

#include "monarch_flight/run/case.h"
#include "run/case/reader.h"

namespace monarch_flight::case_file {

/// `top` laid over `base`: maps are merged key by key, anything else is replaced. A map of `top`
/// whose `type` differs from that of the map below replaces it as a whole.
YAML::Node overlaid(const YAML::Node& base, const YAML::Node& top, bool types = true);

/// The path of a case given by name (config_dir/cases/<name>.yaml) or by path; InputError, naming
/// the cases there are, when there is no such file.
std::string findCase(const std::string& name_or_path, const std::string& config_dir);

/// The case file with everything it refers to laid below it: config_dir/defaults.yaml, the insect's
/// preset (insect/preset), the motion's series (motion/series); and the command line's overrides
/// above it. Relative paths in `file` keys are joined to the folder of the YAML file that names
/// them.
YAML::Node assembleCase(const std::string& path, const CaseOverrides& overrides,
                        const std::string& config_dir, Faults& faults);

/// The same for the top map of a case without a file.
YAML::Node layeredCase(const YAML::Node& given, const CaseOverrides& overrides,
                       const std::string& config_dir, Faults& faults);

}  // namespace monarch_flight::case_file
