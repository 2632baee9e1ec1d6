#pragma once
#include <string>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/math/eigen.h"
#include "monarch_flight/run/output_file.h"

namespace monarch_flight {

/// Shows where the table `name` stands in a checkpoint.
void showMark(StateVisitor& state, const std::string& name, OutputMark& mark);

/// flight.csv: one row per committed step, level 0 included; SI and radians, 17 significant digits.
class FlightTable {
 public:
  /// `resumed`: what `onCheckpoint` has shown, for a table that goes on.
  explicit FlightTable(const std::string& path, StateVisitor* resumed = nullptr);
  void append(const CommittedStep& step);
  void onCheckpoint(StateVisitor& state);
  OutputFile& file() { return file_; }
  /// The column names, comma separated, in the order of the rows.
  static const std::string& header();

 private:
  OutputFile file_;
  std::string row_;
  Eigen::Quaterniond last_{1.0, 0.0, 0.0, 0.0};  // sign of the quaternion stays continuous
};

/// iterations.csv: one row per sub-iteration of every committed step.
class IterationTable {
 public:
  explicit IterationTable(const std::string& path, StateVisitor* resumed = nullptr);
  void append(const CommittedStep& step);
  void onCheckpoint(StateVisitor& state);
  OutputFile& file() { return file_; }
  static const std::string& header();

 private:
  OutputFile file_;
  std::string rows_;
};

}  // namespace monarch_flight
