#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace monarch_flight::verify {

constexpr double kStated = std::numeric_limits<double>::quiet_NaN();

/// One proof in figures. `error` is what `bound` limits; a bound of NaN marks a value that is only
/// stated.
struct DynamicsRow {
  std::string name;        ///< case
  std::string quantity;    ///< what was compared
  std::string resolution;  ///< steps, samples, method
  double computed = 0.0;
  double reference = 0.0;
  double error = 0.0;
  double bound = 0.0;
  bool stated() const { return std::isnan(bound); }
  bool pass() const { return std::isfinite(error) && (stated() || error <= bound); }
};
using DynamicsRows = std::vector<DynamicsRow>;

/// Where the checks find their inputs and leave curves for plots.
struct DynamicsFolders {
  std::string config;  ///< the package's config folder
  std::string data;    ///< the package's test/data folder
  std::string out;     ///< existing folder for CSV curves
};

struct DynamicsCheck {
  std::string name;
  std::function<DynamicsRows(const DynamicsFolders&)> run;
};

DynamicsRows checkConservation(const DynamicsFolders& folders);
DynamicsRows checkEnergy(const DynamicsFolders& folders);
DynamicsRows checkReducedForm(const DynamicsFolders& folders);
DynamicsRows checkNewmark(const DynamicsFolders& folders);
DynamicsRows checkSixDof(const DynamicsFolders& folders);
DynamicsRows checkExactMotions(const DynamicsFolders& folders);
DynamicsRows checkPublished(const DynamicsFolders& folders);
DynamicsRows checkSimbody(const DynamicsFolders& folders);

}  // namespace monarch_flight::verify
