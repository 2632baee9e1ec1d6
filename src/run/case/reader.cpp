#include "run/case/reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>

#include "monarch_flight/math/errors.h"
#include "run/words.h"

namespace monarch_flight::case_file {
namespace {

bool satisfies(double value, Bound::Kind kind) {
  if (!std::isfinite(value)) return false;
  if (kind == Bound::kPositive) return value > 0.0;
  return kind == Bound::kAny || value >= 0.0;
}

const char* boundText(Bound::Kind kind) {
  if (kind == Bound::kPositive) return "> 0";
  return kind == Bound::kNonNegative ? ">= 0" : "a finite number";
}

YAML::Node flow(const std::vector<double>& values) {
  YAML::Node node(YAML::NodeType::Sequence);
  for (const double value : values) node.push_back(exactText(value));
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

}  // namespace

void Faults::add(const std::string& text) {
  if (std::find(texts_.begin(), texts_.end(), text) == texts_.end()) texts_.push_back(text);
}

void Faults::add(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) add(text);
}

bool Faults::incomplete(const std::string& path) const {
  return incomplete_.count(path.substr(0, path.find('/'))) > 0;
}

void Faults::throwIfAny(const std::string& file) const {
  if (texts_.empty()) return;
  const std::string number =
      texts_.size() == 1 ? "1 fault" : std::to_string(texts_.size()) + " faults";
  std::vector<std::string> lines{file + ": " + number};
  for (const std::string& text : texts_) lines.push_back("  " + text);
  throw InputError(lines);
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a section" : "nothing";
}

std::string exactText(double value) {
  char text[40];
  for (int digits = 15; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

Section::Section(YAML::Node node, std::string path, Faults& faults)
    : Section(std::move(node), std::move(path), faults, YAML::Node(YAML::NodeType::Map), false) {}

Section::Section(YAML::Node node, std::string path, Faults& faults, YAML::Node resolved,
                 bool absent)
    : node_(std::move(node)),
      path_(std::move(path)),
      faults_(faults),
      faults_at_start_(faults.count()),
      resolved_(std::move(resolved)),
      absent_(absent) {}

std::string Section::pathOf(const std::string& key) const {
  return path_.empty() ? key : path_ + "/" + key;
}

bool Section::has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined(); }

bool Section::isMap(const std::string& key) const { return has(key) && node_[key].IsMap(); }

std::string Section::textOf(const std::string& key) const {
  return has(key) && node_[key].IsScalar() ? node_[key].Scalar() : "";
}

void Section::fault(const std::string& key, const std::string& text) {
  faults_.add(pathOf(key) + text);
}

YAML::Node Section::take(const std::string& key) {
  known_.insert(key);
  const YAML::Node& map = node_;
  return node_.IsMap() ? YAML::Node(map[key]) : YAML::Node(YAML::NodeType::Undefined);
}

std::optional<YAML::Node> Section::required(const std::string& key, const std::string& what) {
  const YAML::Node node = take(key);
  if (node.IsDefined() && !node.IsNull()) return node;
  if (!absent_ && !faults_.incomplete(path_))
    fault(key, " is missing: must be " + what + "; add it");
  return std::nullopt;
}

std::optional<double> Section::parse(const YAML::Node& node, const std::string& where,
                                     const Bound& bound) {
  const std::string unit = bound.unit.empty() ? "" : " " + bound.unit;
  const std::string remedy = bound.remedy.empty() ? "correct it" : bound.remedy;
  char* end = nullptr;
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') {
    const std::string in = bound.unit.empty() ? "" : " in " + bound.unit;
    faults_.add(where + " = " + shown(node) + ": must be a number" + in + "; " + remedy);
    return std::nullopt;
  }
  if (!satisfies(value, bound.kind)) {
    const std::string kind = boundText(bound.kind);
    const bool finite = std::isfinite(value) || bound.kind == Bound::kAny;
    faults_.add(where + " = " + text + unit + ": must be " + (finite ? "" : "a finite number ") +
                kind + "; " + remedy);
    return std::nullopt;
  }
  return value;
}

double Section::number(const std::string& key, const Bound& bound) {
  const auto node = required(key, bound.unit.empty() ? "a number" : "a number in " + bound.unit);
  const auto value = node ? parse(*node, pathOf(key), bound) : std::nullopt;
  if (value) put(key, exactText(*value));
  return value.value_or(1.0);
}

std::optional<double> Section::maybeNumber(const std::string& key, const Bound& bound) {
  const YAML::Node node = take(key);
  const bool none = !node.IsDefined() || (node.IsScalar() && node.Scalar() == "none");
  const auto value = none ? std::nullopt : parse(node, pathOf(key), bound);
  put(key, value ? exactText(*value) : "none");
  return value;
}

int Section::integer(const std::string& key, const std::string& remedy) {
  const auto node = required(key, "a whole number");
  if (!node) return 1;
  const auto value = parse(*node, pathOf(key), {Bound::kAny, "", remedy});
  if (!value) return 1;
  if (*value != std::floor(*value) || std::abs(*value) > 2e9) {
    fault(key, " = " + node->Scalar() + ": must be a whole number; " + remedy);
    return 1;
  }
  put(key, std::to_string(static_cast<int>(*value)));
  return static_cast<int>(*value);
}

bool Section::flag(const std::string& key) {
  const auto node = required(key, "true or false");
  if (!node) return false;
  const std::string text = node->IsScalar() ? node->Scalar() : "";
  if (text != "true" && text != "false") {
    fault(key, " = " + shown(*node) + ": must be true or false; correct it");
  }
  put(key, text);
  return text == "true";
}

std::string Section::text(const std::string& key) {
  const auto node = required(key, "a text");
  if (!node) return "";
  if (!node->IsScalar()) {
    fault(key, " = " + shown(*node) + ": must be a text; correct it");
    return "";
  }
  put(key, node->Scalar());
  return node->Scalar();
}

std::string Section::name(const std::string& key) {
  constexpr std::size_t kLongest = 200;  // it becomes part of the names of files
  std::string value = text(key);
  if (value.size() > kLongest) {
    fault(key, " has " + std::to_string(value.size()) + " characters: must be at most " +
                   std::to_string(kLongest) + "; shorten it");
  } else if (!std::regex_match(value, std::regex("([A-Za-z0-9][A-Za-z0-9_.-]*)?"))) {
    fault(key, " = '" + value + "': must consist of letters, digits, '_', '-' and '.'; rename it");
  }
  return value;
}

std::string Section::choice(const std::string& key, const std::vector<std::string>& options,
                            const std::string& others) {
  const std::string must = "one of " + joined(options) + others;
  const auto node = required(key, must);
  if (!node) return "";
  std::string text = node->IsScalar() ? node->Scalar() : "";
  if (std::find(options.begin(), options.end(), text) == options.end()) {
    fault(key,
          " = " + shown(*node) + ": must be " + must + "; choose one" + nearest(text, options));
    return "";
  }
  put(key, text);
  return text;
}

std::vector<double> Section::numbers(const std::string& key, const std::string& unit) {
  std::vector<double> values;
  const auto node = required(key, "a list of numbers" + (unit.empty() ? "" : " in " + unit));
  if (!node) return values;
  if (!node->IsSequence()) {
    fault(key, " = " + shown(*node) + ": must be a list of numbers, as [1, 2]; correct it");
    return values;
  }
  for (std::size_t i = 0; i < node->size(); ++i) {
    const std::string where = pathOf(key) + "[" + std::to_string(i) + "]";
    values.push_back(parse((*node)[i], where, {Bound::kAny, unit, ""}).value_or(0.0));
  }
  put(key, values);
  return values;
}

Eigen::Vector3d Section::vector3(const std::string& key, const std::string& unit) {
  const std::vector<double> values = numbers(key, unit);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  if (has(key) && take(key).IsSequence()) {
    fault(key, " has " + std::to_string(values.size()) + " values: must be 3; give [x, y, z]");
  }
  return Eigen::Vector3d::Zero();
}

std::optional<Eigen::Vector3d> Section::maybeVector3(const std::string& key,
                                                     const std::string& unit) {
  const YAML::Node node = take(key);
  if (!node.IsDefined() || (node.IsScalar() && node.Scalar() == "none")) {
    put(key, std::string("none"));
    return std::nullopt;
  }
  return vector3(key, unit);
}

std::vector<std::vector<double>> Section::rows(const std::string& key, std::size_t columns) {
  std::vector<std::vector<double>> result;
  const auto node = required(key, "a list of rows of numbers");
  if (!node) return result;
  if (!node->IsSequence())
    fault(key, " = " + shown(*node) + ": must be a list of rows; correct it");
  for (std::size_t i = 0; i < node->size(); ++i) {
    const YAML::Node row = (*node)[i];
    const std::string where = pathOf(key) + "[" + std::to_string(i) + "]";
    if (!row.IsSequence() || row.size() != columns) {
      faults_.add(where + ": must be a list of " + std::to_string(columns) +
                  " numbers; correct it");
      continue;
    }
    std::vector<double> values;
    for (std::size_t k = 0; k < columns; ++k) {
      values.push_back(parse(row[k], where + "[" + std::to_string(k) + "]", {}).value_or(0.0));
    }
    result.push_back(std::move(values));
  }
  put(key, result);
  return result;
}

Section Section::section(const std::string& key) {
  const YAML::Node node = take(key);
  const bool good = node.IsDefined() && node.IsMap();
  if (!good && node.IsDefined()) {
    fault(key, " = " + shown(node) + ": must be a section of keys; indent its keys below it");
  } else if (!good && !absent_ && !faults_.incomplete(path_)) {
    fault(key, " is missing: must be a section of keys; add it");
  }
  YAML::Node resolved(YAML::NodeType::Map);
  resolved_[key] = resolved;
  return Section(good ? node : YAML::Node(YAML::NodeType::Map), pathOf(key), faults_, resolved,
                 !good);
}

std::vector<Section> Section::sections(const std::string& key) {
  std::vector<Section> result;
  const YAML::Node node = take(key);
  YAML::Node resolved(YAML::NodeType::Sequence);
  resolved_[key] = resolved;
  if (!node.IsDefined()) return result;
  if (!node.IsSequence()) {
    fault(key, " = " + shown(node) + ": must be a list of sections; correct it");
    return result;
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string name = key + "[" + std::to_string(i) + "]";
    if (!node[i].IsMap()) {
      fault(name, " = " + shown(node[i]) + ": must be a section of keys; correct it");
      continue;
    }
    YAML::Node one(YAML::NodeType::Map);
    resolved.push_back(one);
    result.push_back(Section(node[i], pathOf(name), faults_, one, false));
  }
  return result;
}

Section Section::putSection(const std::string& key) {
  YAML::Node resolved(YAML::NodeType::Map);
  resolved_[key] = resolved;
  return Section(YAML::Node(YAML::NodeType::Map), pathOf(key), faults_, resolved, false);
}

void Section::put(const std::string& key, const std::string& value) { resolved_[key] = value; }

void Section::put(const std::string& key, const std::vector<double>& values) {
  resolved_[key] = flow(values);
}

void Section::put(const std::string& key, const std::vector<std::vector<double>>& rows) {
  YAML::Node node(YAML::NodeType::Sequence);
  for (const auto& row : rows) node.push_back(flow(row));
  resolved_[key] = node;
}

void Section::finish() {
  if (!node_.IsMap()) return;
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (known_.count(key) > 0) continue;
    const std::vector<std::string> known(known_.begin(), known_.end());
    fault(key, " is not a known key: known here are " + joined(known) + "; correct or remove it" +
                   nearest(key, known));
  }
}

}  // namespace monarch_flight::case_file
