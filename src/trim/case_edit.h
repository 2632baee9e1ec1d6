#pragma once
#include <yaml-cpp/yaml.h>

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

#include "monarch_flight/insect/fourier_motion.h"

namespace monarch_flight {

/// Changes numbers of a resolved case. Paths must exist but for their last key.
class CaseEdit {
 public:
  using Path = std::vector<std::string>;

  explicit CaseEdit(const std::string& resolved_yaml);
  /// The scalar at a path, "" when there is none.
  std::string at(const Path& path) const;
  void set(const Path& path, double value);
  void set(const Path& path, const std::string& value);
  void setVector(const Path& path, const Eigen::Vector3d& value);
  /// A0, AN, BN, multiple, each coefficient in this unit.
  void setSeries(const Path& path, const FourierSeries& series, double unit);
  /// An empty section where there is none.
  void open(const Path& path);
  void remove(const Path& path);
  std::string text() const;
  /// The text with these comment lines before the keys of these paths ("insect/wing/kappa").
  std::string text(const std::map<std::string, std::string>& comments) const;

 private:
  YAML::Node parent(const Path& path) const;
  YAML::Node root_;
};

}  // namespace monarch_flight
