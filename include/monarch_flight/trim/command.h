#pragma once
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/trim/control_design.h"
#include "monarch_flight/trim/trim.h"

namespace monarch_flight {

/// What `monarch trim` was asked for.
struct TrimCommand {
  std::string case_name = "climb_printed";
  CaseOverrides overrides;  ///< fluid, grid, steps_per_flap
  TrimOptions options;
  std::string out;                        ///< case file to write; empty: none
  std::string jacobian_file;              ///< of another trim; empty: by differences
  int fly = 0;                            ///< free flaps flown and shown at the end
  std::optional<ControlOptions> control;  ///< design a controller instead
  std::string orbit;  ///< reference of the controller: trim, own, or "" for what suits the air
  std::string gains;  ///< of which of them: trim (or ""), own
};

/// From key:=value arguments. Throws InputError with every fault.
TrimCommand trimCommand(const std::vector<std::string>& arguments);

/// Trims, prints the table, writes `out` and `out`.jacobian. 0: converged; 1: not.
int runTrim(TrimCommand command, const std::string& config_dir, std::ostream& out);

/// Throws InputError when `out` with one of these endings exists; "" is no file.
void requireNew(const std::string& out, const std::vector<std::string>& endings);

/// Designs a controller, prints what it does, writes `out`: the case with a section `guidance`.
int runControl(TrimCommand command, const std::string& config_dir, std::ostream& out);

}  // namespace monarch_flight
