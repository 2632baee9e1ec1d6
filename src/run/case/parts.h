#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "monarch_flight/insect/gusts.h"
#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/run/case.h"
#include "run/case/reader.h"

namespace monarch_flight::case_file {

/// Why a lateral value is refused: behind what it must be, before the remedy.
inline constexpr char kMirrored[] = " while only one wing is solved and mirrored; ";

/// The motion of a case before explicit start values are laid over it.
struct CaseMotion {
  std::shared_ptr<const PrescribedMotion> motion;  ///< null when faulty
  double frequency = 0.0;                          ///< flapping frequency [Hz], 0: none
  bool is_table = false;
  bool is_wing_table = false;
  double t_begin = 0.0, t_end = 0.0;  ///< reach of a table [s]
  std::string lateral;  ///< fault of a motion with a lateral velocity; "": it has none
};

/// Explicit start values as written; none: the prescribed motion's.
struct InitialValues {
  std::optional<Eigen::Vector3d> position, velocity;
  std::optional<double> theta_B, theta_B_dot, theta_R, theta_R_dot;
  std::optional<double> theta_L, theta_L_dot;          ///< none: as theta_R; as the mirror image
  std::optional<double> roll, roll_dot, yaw, yaw_dot;  ///< z-y-x angles
};

/// A gust as written.
struct CaseGust {
  bool in_place = false;                                ///< stands in space; else a gust in time
  double start = 0.0;                                   ///< [m] from the run's start, or [s]
  double extent = 1.0;                                  ///< length [m] or duration [s]
  Eigen::Vector3d amplitude = Eigen::Vector3d::Zero();  ///< NED [m/s]
  std::optional<Eigen::Vector3d> direction;  ///< none: the motion's horizontal one at t_start
};

/// The wind of a case before it is laid along the motion.
struct CaseWind {
  Eigen::Vector3d steady = Eigen::Vector3d::Zero();  ///< NED [m/s]
  std::vector<CaseGust> gusts;
  std::shared_ptr<const WindSeries> series;  ///< null: none
};

// One reader a section of the case file (docs/case_files.md). They add faults and return harmless
// values.
/// `mirrored`: both wings are the same.
std::optional<Insect> readInsect(Section section, bool mirrored, Faults& faults);
std::optional<Planform> readPlanform(Section section, Faults& faults);
/// `mirrored`: one wing of two is solved, so that the wind must not blow from the side.
CaseWind readFluid(Section section, bool mirrored, Case& c, Faults& faults);
/// fluid/wind.
CaseWind readWind(Section& fluid, bool mirrored, Faults& faults);
void readGrid(Section section, Case& c, Faults& faults);
/// `chord`: mean chord of the wing, infinite when it is not known [m].
CaseMotion readMotion(Section section, bool bare_wing, double chord, Faults& faults);
InitialValues readInitial(Section& root);
/// `c`: with what is free, time and coupling read.
GuidanceSettings readGuidance(Section section, double frequency, const Case& c, Faults& faults);
FreeCoordinates readFree(Section section, bool mirrored);
void readTime(Section section, double frequency, Case& c);
void readCoupling(Section section, double mean_chord, Case& c, Faults& faults);
void readOutput(Section section, Case& c);
/// The table of `file`, or the `rows` written out in the case; the resolved case holds the rows.
/// Throws InputError for what is wrong with the file.
NumericTable readRows(Section& section, const std::vector<std::string>& columns);

// Checks across sections; each needs a case without faults in what it looks at.
/// Free coordinates that the insect cannot have.
void checkFree(const Case& c, Faults& faults);
/// The motion must reach over the whole run; table kinds must suit the insect.
void checkMotion(const Case& c, const CaseMotion& motion, Faults& faults);
/// What leads the motion must suit it and the run.
void checkGuidance(const Case& c, const CaseMotion& motion, Faults& faults);
/// The wind's table must reach over the whole run.
void checkWind(const Case& c, const CaseWind& wind, Faults& faults);
/// The wind along c.motion, from where that is at t_start.
std::shared_ptr<const WindModel> windOf(const Case& c, const CaseWind& wind, Faults& faults);
/// An insect of which one wing is solved, and mirrored, can have no lateral velocity in its air.
void checkMirrored(const Case& c, const CaseMotion& motion, const InitialValues& initial,
                   Faults& faults);
/// The time step must resolve the motion: turns of the wing and the swings of a free hinge.
void checkTimeStep(const Case& c, Faults& faults);
/// Natural period of a free wing on its hinge, with the quasi-steady added mass about its axis [s];
/// 0 where the pitch is not free or there is no spring.
double hingePeriod(const Case& c, const Wing& wing);
/// How to have steps of at most `dt` [s], for a remedy.
std::string shorterSteps(const Case& c, double dt);
/// Start values must belong to free coordinates; returns them completed from the motion at t_start.
StartValues startValues(const Case& c, const InitialValues& initial, const PrescribedMotion& motion,
                        Faults& faults);
/// The wing must lie inside its grid, and the peak speed of the wing within the Courant limit.
void checkGrid(const Case& c, Faults& faults);

}  // namespace monarch_flight::case_file
