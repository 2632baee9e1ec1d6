#include "trim/case_edit.h"

#include <cstdlib>
#include <sstream>

#include "run/case/reader.h"

namespace monarch_flight {
namespace {

YAML::Node sequence(const std::vector<double>& values, double unit) {
  YAML::Node node(YAML::NodeType::Sequence);
  for (double value : values) node.push_back(case_file::exactText(value / unit));
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

YAML::Node child(const YAML::Node& node, const std::string& key) {
  if (node.IsSequence()) return node[std::strtoul(key.c_str(), nullptr, 10)];
  return node[key];
}

void comment(std::ostream& out, const std::string& text, const std::string& indent) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out << indent << "# " << line << '\n';
}

void write(std::ostream& out, const YAML::Node& map, const std::string& above,
           const std::string& indent, const std::map<std::string, std::string>& comments) {
  for (const auto& entry : map) {
    const std::string key = entry.first.Scalar(), path = above + key;
    const auto found = comments.find(path);
    if (found != comments.end()) comment(out, found->second, indent);
    out << indent << key << ':';
    if (entry.second.IsMap()) {
      out << '\n';
      write(out, entry.second, path + "/", indent + "  ", comments);
      continue;
    }
    YAML::Node inline_value = YAML::Clone(entry.second);  // one line, however the case had it
    inline_value.SetStyle(YAML::EmitterStyle::Flow);
    YAML::Emitter value;
    value << inline_value;
    out << ' ' << value.c_str() << '\n';
  }
}

}  // namespace

CaseEdit::CaseEdit(const std::string& resolved_yaml) : root_(YAML::Load(resolved_yaml)) {}

YAML::Node CaseEdit::parent(const Path& path) const {
  YAML::Node node = root_;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) node.reset(child(node, path[i]));
  return node;
}

std::string CaseEdit::at(const Path& path) const {
  const YAML::Node above = parent(path);
  if (!above.IsDefined() || above.IsScalar() || above.IsNull()) return "";
  const YAML::Node node = child(above, path.back());
  return node.IsDefined() && node.IsScalar() ? node.Scalar() : "";
}

void CaseEdit::set(const Path& path, double value) { set(path, case_file::exactText(value)); }

void CaseEdit::set(const Path& path, const std::string& value) {
  YAML::Node above = parent(path);
  if (above.IsSequence()) {
    above[std::strtoul(path.back().c_str(), nullptr, 10)] = value;
  } else {
    above[path.back()] = value;
  }
}

void CaseEdit::setVector(const Path& path, const Eigen::Vector3d& value) {
  parent(path)[path.back()] = sequence({value.x(), value.y(), value.z()}, 1.0);
}

void CaseEdit::setSeries(const Path& path, const FourierSeries& series, double unit) {
  YAML::Node node(YAML::NodeType::Map);
  node["A0"] = case_file::exactText(series.a0 / unit);
  node["AN"] = sequence(series.an, unit);
  node["BN"] = sequence(series.bn, unit);
  node["multiple"] = std::to_string(series.multiple);
  parent(path)[path.back()] = node;
}

void CaseEdit::open(const Path& path) {
  YAML::Node above = parent(path);
  if (!above[path.back()].IsDefined()) above[path.back()] = YAML::Node(YAML::NodeType::Map);
}

void CaseEdit::remove(const Path& path) { parent(path).remove(path.back()); }

std::string CaseEdit::text() const { return text({}); }

std::string CaseEdit::text(const std::map<std::string, std::string>& comments) const {
  std::ostringstream out;
  write(out, root_, "", "", comments);
  return out.str();
}

}  // namespace monarch_flight
