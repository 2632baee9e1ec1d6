#include "run/case/sources.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <vector>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/run_keys.h"
#include "run/case/document.h"

namespace monarch_flight::case_file {
namespace {

namespace fs = std::filesystem;

YAML::Node get(const YAML::Node& map, const std::string& key) {
  return map.IsDefined() && map.IsMap() ? YAML::Node(map[key])
                                        : YAML::Node(YAML::NodeType::Undefined);
}

constexpr char kPreset[] = ".yaml", kSeries[] = "_kinematics.yaml";  // ends of file names

/// What stands before `ending` in the file names of a folder, for messages.
std::string namesIn(const fs::path& folder, const std::string& ending) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool series = name.size() > std::string(kSeries).size() &&
                        name.substr(name.size() - std::string(kSeries).size()) == kSeries;
    if (name.size() <= ending.size() || series != (ending == kSeries)) continue;
    const std::size_t stem = name.size() - ending.size();
    if (name.substr(stem) == ending) names.push_back(name.substr(0, stem));
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// Joins every relative `file` below `node` to `folder`.
void anchorFiles(YAML::Node node, const fs::path& folder) {
  if (!node.IsMap()) return;
  for (auto entry : node) {
    if (entry.first.Scalar() == "file" && entry.second.IsScalar()) {
      const fs::path file = entry.second.Scalar();
      if (file.is_relative()) entry.second = (folder / file).lexically_normal().string();
    } else {
      anchorFiles(entry.second, folder);
    }
  }
}

/// A YAML file, its relative paths joined to its folder.
YAML::Node loadMap(const fs::path& path) {
  const YAML::Node node = caseFile(path.string());
  anchorFiles(node, fs::absolute(path).parent_path());
  return node;
}

/// Where two keys of one name stand, where that is known: a node that no text was read for has no
/// line.
std::string bothLines(int first, int second) {
  if (first < 0 || second < 0) return "";
  return first == second
             ? " (line " + std::to_string(first + 1) + ")"
             : " (lines " + std::to_string(first + 1) + " and " + std::to_string(second + 1) + ")";
}

/// Keys given twice, at every depth.
void checkTwins(const YAML::Node& map, const std::string& above, Faults& faults) {
  std::map<std::string, int> first_line;
  for (const auto& entry : map) {
    const std::string key = above + entry.first.Scalar();
    const YAML::Node& value = entry.second;
    const int line = entry.first.Mark().line;
    const auto [first, is_new] = first_line.emplace(key, line);
    if (!is_new)
      faults.add(key + " is given twice" + bothLines(first->second, line) + "; remove one of them");
    if (value.IsMap()) checkTwins(value, key + "/", faults);
    for (std::size_t i = 0; value.IsSequence() && i < value.size(); ++i) {
      if (value[i].IsMap()) checkTwins(value[i], key + "[" + std::to_string(i) + "]/", faults);
    }
  }
}

/// Lays the file that `section/key` names (stem + suffix in config_dir/insects) below the section.
void layBelow(YAML::Node root, const std::string& section, const std::string& key,
              const std::string& suffix, const std::string& config_dir, Faults& faults) {
  const YAML::Node top = get(root, section);
  if (!top.IsDefined() || !get(top, key).IsDefined()) return;
  const std::string name = get(top, key).IsScalar() ? get(top, key).Scalar() : "";
  const fs::path folder = fs::path(config_dir) / "insects";
  const fs::path file = folder / (name + suffix);
  if (name.empty() || !fs::exists(file)) {
    faults.add(section + "/" + key + " = '" + name + "': " + file.string() +
               " does not exist; there are " + namesIn(folder, suffix));
    root[section].remove(key);
    faults.markIncomplete(section);
    return;
  }
  try {
    const YAML::Node below = loadMap(file);
    checkTwins(below, file.string() + ": ", faults);
    YAML::Node merged = overlaid(below, top);
    merged.remove(key);
    root[section] = merged;
  } catch (const InputError& e) {
    faults.add(e.what());
    root[section].remove(key);
    faults.markIncomplete(section);
  }
}

/// grid:=level takes that level's resolution and extent; the boundary and the Courant limit stay.
void overrideGrid(YAML::Node root, const std::string& level) {
  YAML::Node grid(YAML::NodeType::Map);
  const YAML::Node old = get(root, "grid");
  grid["level"] = level;
  for (const char* key : {"outer", "courant_limit"}) {
    if (old.IsDefined() && get(old, key).IsDefined()) grid[key] = YAML::Clone(get(old, key));
  }
  root["grid"] = grid;
}

std::string overrideNames(const std::vector<RunKey>& keys) {
  std::string names;
  for (const RunKey& key : keys) {
    if (!key.override.empty()) names += (names.empty() ? "" : ", ") + key.name;
  }
  return names;
}

void applyOverrides(YAML::Node root, const CaseOverrides& overrides, const std::string& config_dir,
                    Faults& faults) {
  if (overrides.empty()) return;
  const std::vector<RunKey>& keys = runKeys(config_dir);
  for (const auto& [key, value] : overrides) {
    if (key == "grid") {
      overrideGrid(root, value);
      continue;
    }
    const RunKey* known = findKey(keys, key);
    if (known == nullptr || known->override.empty()) {
      faults.add(key + ":=" + value + " is not a known override: known are " + overrideNames(keys) +
                 "; correct or remove it");
      continue;
    }
    const std::size_t mark = known->override.find('/');
    if (mark == std::string::npos) {
      root[known->override] = value;
      continue;
    }
    const std::string section = known->override.substr(0, mark);
    const std::string name = known->override.substr(mark + 1);
    if (!get(root, section).IsDefined() || !get(root, section).IsMap()) continue;
    root[section][name] = value;
    if (key == "guidance_file") root[section].remove("rows");  // of a resolved case
  }
}

/// coupling/prescribed_flaps as steps: whoever reads the case later finds these alone.
void countPrescribedSteps(YAML::Node root, const YAML::Node& given, Faults& faults) {
  YAML::Node coupling = get(root, "coupling");
  const YAML::Node flaps = get(coupling, "prescribed_flaps");
  if (!flaps.IsDefined()) return;
  const std::string where = "coupling/prescribed_flaps";
  const YAML::Node steps = get(get(root, "time"), "steps_per_flap");
  double number = 0.0;
  int per_flap = 0;
  if (get(get(given, "coupling"), "prescribed_steps").IsDefined()) {
    faults.add(where + ": prescribed_steps is given, too; remove one of them");
  } else if (!YAML::convert<double>::decode(flaps, number) || !(number >= 0.0 && number <= 1e6)) {
    faults.add(where + (flaps.IsScalar() ? " = " + flaps.Scalar() : "") +
               ": must be a number of flaps from 0 to 1e6; 1 is usual");
  } else if (!steps.IsDefined()) {
    faults.add(where + ": needs time/steps_per_flap; give prescribed_steps instead");
  } else if (YAML::convert<int>::decode(steps, per_flap) &&
             per_flap >= 1) {  // else time has a fault
    const double count = std::round(number * per_flap);
    if (count > std::numeric_limits<int>::max())
      faults.add(where + " = " + flaps.Scalar() +
                 " amounts to more than 2147483647 steps; give less");
    else
      coupling["prescribed_steps"] = std::to_string(static_cast<int>(count));
  }
  coupling.remove("prescribed_flaps");
}

}  // namespace

YAML::Node overlaid(const YAML::Node& base, const YAML::Node& top, bool types) {
  if (!base.IsDefined() || !base.IsMap() || !top.IsMap()) return YAML::Clone(top);
  const YAML::Node type_below = get(base, "type");
  const YAML::Node type_above = get(top, "type");
  if (types && type_below.IsDefined() && type_above.IsDefined() && type_below.IsScalar() &&
      type_above.IsScalar() && type_below.Scalar() != type_above.Scalar()) {
    return YAML::Clone(top);
  }
  YAML::Node result = YAML::Clone(base);
  for (const auto& entry : top) {
    const std::string key = entry.first.Scalar();
    const YAML::Node below = get(base, key);
    // All types of guidance have the same keys.
    result[key] = below.IsDefined() ? overlaid(below, entry.second, key != "guidance")
                                    : YAML::Clone(entry.second);
  }
  return result;
}

std::string findCase(const std::string& name_or_path, const std::string& config_dir) {
  const fs::path folder = fs::path(config_dir) / "cases";
  const fs::path given = name_or_path;
  const bool is_path = given.has_parent_path() || given.extension() == ".yaml";
  const fs::path path = is_path ? given : folder / (name_or_path + ".yaml");
  if (!name_or_path.empty() && fs::is_regular_file(path)) return path.string();
  throw InputError("case = '" + name_or_path + "': " + path.string() +
                   " does not exist; give a path or one of " + namesIn(folder, ".yaml"));
}

YAML::Node assembleCase(const std::string& path, const CaseOverrides& overrides,
                        const std::string& config_dir, Faults& faults) {
  return layeredCase(loadMap(path), overrides, config_dir, faults);
}

YAML::Node layeredCase(const YAML::Node& given, const CaseOverrides& overrides,
                       const std::string& config_dir, Faults& faults) {
  checkTwins(given, "", faults);  // before maps are merged
  YAML::Node root = overlaid(loadMap(fs::path(config_dir) / "defaults.yaml"), given);
  layBelow(root, "insect", "preset", kPreset, config_dir, faults);
  layBelow(root, "motion", "series", kSeries, config_dir, faults);
  applyOverrides(root, overrides, config_dir, faults);
  countPrescribedSteps(root, given, faults);
  const auto file = overrides.find("guidance_file");
  const YAML::Node type = get(get(root, "guidance"), "type");
  if (file != overrides.end() && !(type.IsDefined() && type.Scalar() == "replay")) {
    faults.add(
        "guidance_file:=" + file->second +
        ": only guidance:=replay reads a recorded flight; give that too, or leave the file out");
  }
  return root;
}

}  // namespace monarch_flight::case_file
