#include "run/case/difference.h"

#include <yaml-cpp/yaml.h>

#include <map>
#include <set>

namespace monarch_flight::case_file {
namespace {

using Keys = std::map<std::string, std::string>;

/// Every key of a case with its value as text; sequences are values.
void flatten(const YAML::Node& node, const std::string& above, Keys& keys) {
  for (const auto& entry : node) {
    const std::string key = above + entry.first.Scalar();
    if (entry.second.IsMap()) {
      flatten(entry.second, key + "/", keys);
      continue;
    }
    YAML::Emitter value;
    value << YAML::Flow << entry.second;
    keys[key] = value.c_str();
  }
}

bool mayChange(const std::string& key) {
  static const std::set<std::string> free{"name",
                                          "description",
                                          "watchdog_s",
                                          "time/flaps",
                                          "time/duration",
                                          "coupling/relaxation",
                                          "coupling/omega_initial",
                                          "coupling/omega_min",
                                          "coupling/omega_max",
                                          "coupling/reuse_steps",
                                          "coupling/operator_every",
                                          "coupling/tolerance",
                                          "coupling/load_tolerance",
                                          "coupling/max_sub_iterations"};
  return free.count(key) > 0 || key.rfind("output/", 0) == 0;
}

std::string shown(const Keys& keys, const std::string& key) {
  const auto found = keys.find(key);
  if (found == keys.end()) return "(none)";
  return found->second.size() > 60 ? found->second.substr(0, 57) + "..." : found->second;
}

}  // namespace

CaseDifference caseDifference(const std::string& before, const std::string& now) {
  Keys old, current;
  flatten(YAML::Load(before), "", old);
  flatten(YAML::Load(now), "", current);
  Keys all = old;
  all.insert(current.begin(), current.end());
  CaseDifference difference;
  for (const auto& [key, unused] : all) {
    const auto a = old.find(key), b = current.find(key);
    if (a != old.end() && b != current.end() && a->second == b->second) continue;
    (mayChange(key) ? difference.allowed : difference.forbidden)
        .push_back(key + ": " + shown(old, key) + " -> " + shown(current, key));
  }
  return difference;
}

}  // namespace monarch_flight::case_file
