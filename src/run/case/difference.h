#pragma once
#include <string>
#include <vector>

namespace monarch_flight::case_file {

/// Keys in which two resolved cases differ, "time/flaps: 2 -> 3".
struct CaseDifference {
  std::vector<std::string> allowed;    ///< a flight may go on with them changed
  std::vector<std::string> forbidden;  ///< they make it another flight
};

/// A flight may go on with another length, another way to bring a step to convergence, and other
/// outputs. `before`, `now`: resolved cases as YAML.
CaseDifference caseDifference(const std::string& before, const std::string& now);

}  // namespace monarch_flight::case_file
