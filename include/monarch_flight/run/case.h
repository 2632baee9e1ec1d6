#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/fluid/fluid_model.h"
#include "monarch_flight/fluid/grid_settings.h"
#include "monarch_flight/fluid/quasi_steady.h"
#include "monarch_flight/insect/build.h"
#include "monarch_flight/insect/insect.h"
#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/insect/wind_model.h"
#include "monarch_flight/run/guidance_settings.h"

namespace monarch_flight {

enum class FluidKind { kNavierStokes, kQuasiSteady, kPlugin };

/// Time as integer steps: t = t_start + step * dt.
struct TimeGrid {
  double period = 0.0;      ///< flapping period, or 0 for a motion without one [s]
  double t_start = 0.0;     ///< time of step 0 [s]
  double dt = 0.0;          ///< [s]
  std::uint32_t steps = 0;  ///< whole steps of the whole run
  double remainder = 0.0;   ///< steps that the length asked for has more, below 1; not flown
  double time(std::uint32_t step) const { return t_start + step * dt; }
  /// Steps per flap, or 0 without a period.
  double stepsPerFlap() const { return period > 0 ? period / dt : 0.0; }
};

struct OutputSettings {
  bool record = true;          ///< write flight.bag
  int surface_every = 10;      ///< steps between wing-pressure pictures (0: never)
  int flow_every = 10;         ///< steps between pictures of the flow around the wings (0: never)
  int flow_points = 40000;     ///< points at most in such a picture, for each solved wing
  int fields_every = 0;        ///< steps between files of the whole flow (0: never)
  int checkpoint_every = 250;  ///< steps between checkpoints (0: never)
};

/// Everything a run needs, checked and complete. Made by loadCase; never half-valid.
struct Case {
  std::string name;
  Insect insect = makeBareWing("", {}, Planform::rectangle(1, 1, 0));
  bool mirrored = true;  ///< one wing is solved, the other is its mirror image; else both are
  /// Wings whose air is solved.
  Sides sides() const { return {mirrored ? 1U : 2U}; }
  Air air;
  std::shared_ptr<const WindModel> wind = std::make_shared<SteadyWind>();
  double gravity = 9.81;  ///< [m/s^2], along +z of NED
  FluidKind fluid = FluidKind::kNavierStokes;
  PluginChoice fluid_plugin;  ///< of kPlugin
  BladeElementVariant blade_element = BladeElementVariant::kSaneDickinson;
  GridSettings grid;
  /// Motion of everything that is prescribed, and of the free coordinates during the prescribed
  /// start (explicit initial values of free coordinates are already in it: q0 + qd0 t).
  std::shared_ptr<const PrescribedMotion> motion;
  GuidanceSettings guidance;  ///< who prescribes it, step by step
  FreeCoordinates free;
  TimeGrid time;
  CouplingSettings coupling;
  OutputSettings output;
  double watchdog_s = 60.0;   ///< wall-clock limit of one exchange with a node [s]
  std::string resolved_yaml;  ///< the case file with every key written out
  std::string sha256;         ///< of resolved_yaml, hex: what the handshake compares
};

/// Its flow model, as fluid/solver names it.
std::string fluidName(const Case& c);

/// `overrides` from the command line: keys of config/keys.yaml with a place in the case file, each
/// a YAML scalar.
using CaseOverrides = std::map<std::string, std::string>;

/// Reads a case by name (`config/cases/<name>.yaml` under `config_dir`) or by path; applies
/// overrides; resolves presets and tables relative to the case file; throws InputError with every
/// fault at once.
Case loadCase(const std::string& name_or_path, const CaseOverrides& overrides,
              const std::string& config_dir);

/// The same for a case that is at hand as text (a resolved case, with some of its keys changed);
/// relative paths in it are as they stand. `name` stands for the file in messages.
Case caseFromText(const std::string& yaml, const std::string& name, const CaseOverrides& overrides,
                  const std::string& config_dir);

}  // namespace monarch_flight
