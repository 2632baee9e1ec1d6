#pragma once
#include <yaml-cpp/yaml.h>

#include <string>

namespace monarch_flight::case_file {

/// The top map of a YAML text; `name` stands for it in messages. Throws InputError, with line and
/// column, when it is not YAML or not a map, when it is nested deeper than any case, and when it
/// refers to itself by aliases (*name): such a text may be without end.
YAML::Node caseDocument(const std::string& text, const std::string& name);

/// The same for a file.
YAML::Node caseFile(const std::string& path);

}  // namespace monarch_flight::case_file
