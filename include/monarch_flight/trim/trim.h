#pragma once
#include <complex>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/trim/flap_map.h"
#include "monarch_flight/trim/newton.h"

namespace monarch_flight {

/// What a fitted flight shall look like; the tolerance is the weight: a miss by it counts as 1.
struct TrimTarget {
  enum Kind { kClimb, kSpeed, kPitch, kSwing };
  Kind kind = kClimb;
  double value = 0.0;      ///< rad, or m/s for the speed
  double tolerance = 1.0;  ///< the same
  double of(const Flap& flap) const;
  static const char* name(Kind kind);
};

struct TrimResult;

struct TrimOptions {
  std::vector<TrimParameter> parameters;  ///< to be fitted, with their ranges
  std::vector<TrimTarget> targets;
  std::optional<FlapState> start;  ///< else the case's
  int run_in = 0;                  ///< prescribed flaps before the flap that is trimmed
  /// Free flaps each of which shall meet the targets. Above 1 the search is a shooting problem over
  /// all of them, for unstable flight and air with memory: one run-in for all points, and the state
  /// after one flap counts little.
  int horizon = 1;
  NewtonSettings newton;
  Eigen::MatrixXd jacobian;  ///< of another air or grid, to begin Broyden's method with
  /// Hears of every better point behind the first Jacobian: what a long search that is stopped
  /// leaves behind.
  std::function<void(const TrimResult&)> better;
};

struct FloquetMode {
  std::complex<double> multiplier;  ///< growth over a flap
  Eigen::VectorXcd mode;            ///< of the free states, scaled, largest component 1
};

struct TrimResult {
  NewtonResult newton;
  TrimPoint point;
  std::vector<Flap> flaps;           ///< those of the horizon, from the point
  std::vector<FloquetMode> floquet;  ///< by magnitude, largest first
  double wall_s = 0.0;
  int flaps_flown = 0;  ///< run-ins included
};

/// Multipliers and modes of the map with this Jacobian of (end - start) for dimensionless states.
std::vector<FloquetMode> floquet(const Eigen::MatrixXd& periodicity_jacobian);

/// Jacobian of the stacked residual over `horizon` flaps from one over fewer (n rows of
/// periodicity, m targets a flap; n states stand in front): a later flap is the one before it,
/// flown from the state one flap on. Throws InputError when the rows are not those of whole flaps.
Eigen::MatrixXd overHorizon(const Eigen::MatrixXd& jacobian, Eigen::Index n, Eigen::Index m,
                            int horizon);

/// Finds the periodic flight. Progress goes to `log`, a line an iteration. Throws InputError (no
/// range, a start outside it) and NumericalError (the first flight fails).
TrimResult trim(const Case& c, const std::string& config_dir, const TrimOptions& options,
                std::ostream& log);

/// The table of a result for people.
void printTrim(std::ostream& out, const FlapMap& map, const TrimOptions& options,
               const TrimResult& result);

/// The result as a case file: every key, and comments that say of each changed number what it was
/// fitted to and how well.
std::string trimmedCase(const FlapMap& map, const TrimOptions& options, const TrimResult& result,
                        int run_in_steps, int flaps);

}  // namespace monarch_flight
