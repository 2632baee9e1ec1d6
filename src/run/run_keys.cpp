#include "monarch_flight/run/run_keys.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

std::vector<std::string> texts(const YAML::Node& list) {
  return list ? list.as<std::vector<std::string>>() : std::vector<std::string>();
}

RunKey keyFrom(const std::string& name, const YAML::Node& fields) {
  RunKey key;
  key.name = name;
  key.type = fields["type"].as<std::string>();
  key.choices = texts(fields["choices"]);
  key.of = texts(fields["of"]);
  if (fields["above"]) key.above = fields["above"].as<double>();
  if (fields["from"]) key.from = fields["from"].as<double>();
  if (fields["to"]) key.to = fields["to"].as<double>();
  if (fields["override"]) key.override = fields["override"].as<std::string>();
  return key;
}

std::vector<RunKey> read(const std::string& path) {
  try {
    std::vector<RunKey> keys;
    for (const auto& entry : YAML::LoadFile(path))
      keys.push_back(keyFrom(entry.first.Scalar(), entry.second));
    return keys;
  } catch (const YAML::Exception& e) {
    throw InputError(path + ": " + e.what() + "; build or install the package again");
  }
}

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// a, b or c.
std::string either(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

/// NaN where the text is no finite number.
double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value) ? value : std::nan("");
}

}  // namespace

bool RunKey::takenBy(const std::string& taker) const {
  return std::find(of.begin(), of.end(), taker) != of.end();
}

std::string RunKey::fault(const std::string& value) const {
  if (type == "choice")
    return std::find(choices.begin(), choices.end(), value) != choices.end() ? "" : either(choices);
  if (type == "truth") return value == "true" || value == "false" ? "" : "true or false";
  if (type == "number") {
    const double x = number(value);
    if (!std::isnan(x) && (!above || x > *above)) return "";
    return "a number" + (above ? " > " + shown(*above) : "");
  }
  if (type == "count") {
    const double x = number(value);
    if (x == std::floor(x) && x >= from && x <= to.value_or(1e15)) return "";
    return to ? "a whole number from " + shown(from) + " to " + shown(*to)
              : "a whole number >= " + shown(from);
  }
  return "";
}

const std::vector<RunKey>& runKeys(const std::string& config_dir) {
  static std::mutex mutex;
  static std::map<std::string, std::vector<RunKey>> read_already;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = read_already.find(config_dir);
  if (found != read_already.end()) return found->second;
  return read_already[config_dir] = read(config_dir + "/keys.yaml");
}

const RunKey* findKey(const std::vector<RunKey>& keys, const std::string& name) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const RunKey& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

}  // namespace monarch_flight
