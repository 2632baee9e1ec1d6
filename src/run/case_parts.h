#pragma once
#include <memory>
#include <optional>

#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/run/case.h"
#include "run/case_reader.h"

namespace monarch_flight {

/// The motion of a case before explicit start values are laid over it.
struct CaseMotion {
  std::shared_ptr<const PrescribedMotion> motion;  ///< null when faulty
  double frequency = 0.0;                          ///< flapping frequency [Hz], 0: none
  bool is_table = false;
  bool is_wing_table = false;
  double t_begin = 0.0, t_end = 0.0;  ///< reach of a table [s]
};

/// Explicit start values as written; none: the prescribed motion's.
struct InitialValues {
  std::optional<Eigen::Vector3d> position, velocity;
  std::optional<double> theta_B, theta_B_dot, theta_R, theta_R_dot;
};

// One reader a section of the case file (docs/case_files.md). They add faults and return harmless
// values.
std::optional<Insect> readInsect(Section section, Faults& faults);
std::optional<Planform> readPlanform(Section section, Faults& faults);
void readFluid(Section section, Case& c);
void readGrid(Section section, Case& c, Faults& faults);
CaseMotion readMotion(Section section, bool bare_wing, Faults& faults);
InitialValues readInitial(Section& root);
/// Behind motion, free, time and coupling, which a controller is checked against.
GuidanceSettings readGuidance(Section section, double frequency, const Case& c, Faults& faults);
FreeCoordinates readFree(Section section);
void readTime(Section section, double frequency, Case& c);
void readCoupling(Section section, double mean_chord, Case& c, Faults& faults);
void readOutput(Section section, Case& c);

// Checks across sections; each needs a case without faults in what it looks at.
/// Free coordinates that the insect cannot have.
void checkFree(const Case& c, Faults& faults);
/// The motion must reach over the whole run; table kinds must suit the insect.
void checkMotion(const Case& c, const CaseMotion& motion, Faults& faults);
/// What leads the motion must suit it and the run.
void checkGuidance(const Case& c, const CaseMotion& motion, Faults& faults);
/// Start values must belong to free coordinates; returns them completed from the motion at t_start.
StartValues startValues(const Case& c, const InitialValues& initial, const PrescribedMotion& motion,
                        Faults& faults);
/// The wing must lie inside its grid, and the peak speed of the wing within the Courant limit.
void checkGrid(const Case& c, Faults& faults);

}  // namespace monarch_flight
