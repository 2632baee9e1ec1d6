#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "monarch_flight/trim/trim.h"

namespace monarch_flight {

/// What `scripts/trim` was asked for.
struct TrimCommand {
  std::string case_name = "climb";
  CaseOverrides overrides;  ///< fluid, grid, steps_per_flap
  TrimOptions options;
  std::string out;           ///< case file to write; empty: none
  std::string jacobian_file; ///< of another trim; empty: by differences
  int fly = 0;               ///< free flaps flown and shown at the end
};

/// From key:=value arguments. Throws InputError with every fault.
TrimCommand trimCommand(const std::vector<std::string>& arguments);

/// Trims, prints the table, writes `out` and `out`.jacobian. 0: converged; 1: not.
int runTrim(TrimCommand command, const std::string& config_dir, std::ostream& out);

}  // namespace monarch_flight
