#pragma once
#include <yaml-cpp/yaml.h>

#include <Eigen/Dense>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace monarch_flight::case_file {

/// All faults of a case file, in the order in which they are found.
class Faults {
 public:
  void add(const std::string& text);
  void add(const std::vector<std::string>& texts);
  std::size_t count() const { return texts_.size(); }
  /// What a section builds on could not be read: keys missing in it are no further faults.
  void markIncomplete(const std::string& section) { incomplete_.insert(section); }
  bool incomplete(const std::string& path) const;
  /// InputError with every fault, "<file>: n faults" in front; nothing without a fault.
  void throwIfAny(const std::string& file) const;

 private:
  std::vector<std::string> texts_;
  std::set<std::string> incomplete_;
};

/// What a number must satisfy, and what to do when it does not.
struct Bound {
  enum Kind { kAny, kPositive, kNonNegative };
  Kind kind = kAny;
  std::string unit;    ///< "" when dimensionless
  std::string remedy;  ///< "" : nothing better to say than to correct it
};

/// What the user wrote, for messages.
std::string shown(const YAML::Node& node);

/// Whether a name is a plugin's: package/Name.
bool isPluginName(const std::string& name);

/// Shortest decimal text that reads back as exactly this number.
std::string exactText(double value);

/// One map of a case file. Reading a key checks presence and type and writes the value, in the
/// order of reading, into `resolved()`: the resolved case file holds exactly what was read. Faults
/// are collected, a harmless value is returned in place of a faulty one.
class Section {
 public:
  Section(YAML::Node node, std::string path, Faults& faults);

  const std::string& path() const { return path_; }
  std::string pathOf(const std::string& key) const;
  bool has(const std::string& key) const;
  bool isMap(const std::string& key) const;
  /// The scalar of a key as it stands, "" when there is none; reads nothing.
  std::string textOf(const std::string& key) const;
  /// No fault was added since this section was opened.
  bool clean() const { return !absent_ && faults_.count() == faults_at_start_; }
  void fault(const std::string& key, const std::string& text);

  double number(const std::string& key, const Bound& bound);
  /// `none` or a missing key give nothing, and `none` in the resolved file.
  std::optional<double> maybeNumber(const std::string& key, const Bound& bound);
  int integer(const std::string& key, const std::string& remedy);
  bool flag(const std::string& key);
  std::string text(const std::string& key);
  /// A text that can stand in file names, URDF and messages: letters, digits, '_', '-' and '.'.
  std::string name(const std::string& key);
  /// `others`: what else may stand there, for messages alone.
  std::string choice(const std::string& key, const std::vector<std::string>& options,
                     const std::string& others = "");
  /// The same, or the name of a plugin; `example` is one.
  std::string choiceOrPlugin(const std::string& key, const std::vector<std::string>& options,
                             const std::string& example);
  /// A map of whatever is in it; none when the key is missing. Returns it as YAML.
  std::string anything(const std::string& key);
  std::vector<double> numbers(const std::string& key, const std::string& unit);
  Eigen::Vector3d vector3(const std::string& key, const std::string& unit);
  std::optional<Eigen::Vector3d> maybeVector3(const std::string& key, const std::string& unit);
  /// A sequence of rows of `columns` numbers each.
  std::vector<std::vector<double>> rows(const std::string& key, std::size_t columns);
  Section section(const std::string& key);
  /// A list of sections; none when the key is missing.
  std::vector<Section> sections(const std::string& key);

  /// Marks a key as known without writing it; returns its node.
  YAML::Node take(const std::string& key);
  /// Writes values that come from elsewhere (a file) into the resolved case.
  void put(const std::string& key, const std::string& value);
  void put(const std::string& key, const std::vector<double>& values);
  void put(const std::string& key, const std::vector<std::vector<double>>& rows);
  Section putSection(const std::string& key);

  /// Unknown keys are faults. Call after the last read.
  void finish();
  YAML::Node resolved() const { return resolved_; }

 private:
  Section(YAML::Node node, std::string path, Faults& faults, YAML::Node resolved, bool absent);
  std::optional<double> parse(const YAML::Node& node, const std::string& where, const Bound& bound);
  /// The node of a required key, or nothing (with a fault).
  std::optional<YAML::Node> required(const std::string& key, const std::string& what);

  YAML::Node node_;
  std::string path_;
  Faults& faults_;
  std::size_t faults_at_start_;
  YAML::Node resolved_;
  bool absent_;  ///< the whole section is missing (one fault already says so)
  std::set<std::string> known_;
};

}  // namespace monarch_flight::case_file
