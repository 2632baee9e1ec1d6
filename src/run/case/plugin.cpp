// What a case says of a plugin: its name, and parameters that only the plugin knows.
#include <regex>

#include "run/case/reader.h"

namespace monarch_flight::case_file {
namespace {

/// The same content as text that does not depend on how it was written.
YAML::Node plain(const YAML::Node& node) {
  if (node.IsNull()) return YAML::Node(YAML::NodeType::Null);
  if (node.IsScalar()) return YAML::Node(node.Scalar());
  YAML::Node kept(node.Type());
  if (node.size() == 0) kept.SetStyle(YAML::EmitterStyle::Flow);
  for (const auto& entry : node) {
    if (node.IsMap()) {
      kept.force_insert(plain(entry.first), plain(entry.second));
    } else {
      kept.push_back(plain(entry));
    }
  }
  return kept;
}

}  // namespace

bool isPluginName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  static const std::regex form("[A-Za-z][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)+");
  return name.size() <= kLongest && std::regex_match(name, form);
}

std::string Section::choiceOrPlugin(const std::string& key, const std::vector<std::string>& options,
                                    const std::string& example) {
  const std::string name = textOf(key);
  if (name.find('/') == std::string::npos) {
    return choice(key, options, ", or a plugin, as " + example);
  }
  if (isPluginName(name)) return text(key);
  take(key);
  fault(key, " = '" + name + "': must be package/Name of a plugin, as " + example +
                 ", of letters, digits and '_'; correct it");
  return "";
}

std::string Section::anything(const std::string& key) {
  const YAML::Node node = take(key);
  const bool given = node.IsDefined() && !node.IsNull();
  if (given && !node.IsMap())
    fault(key, " = " + shown(node) + ": must be a section of keys; indent its keys below it");
  const YAML::Node kept = plain(given && node.IsMap() ? node : YAML::Node(YAML::NodeType::Map));
  resolved_[key] = kept;
  YAML::Emitter emitter;
  emitter << kept;
  return emitter.c_str();
}

}  // namespace monarch_flight::case_file
