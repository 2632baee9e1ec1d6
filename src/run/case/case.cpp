#include "monarch_flight/run/case.h"

#include <limits>

#include "monarch_flight/run/sha256.h"
#include "run/case/document.h"
#include "run/case/parts.h"
#include "run/case/sources.h"

namespace monarch_flight::case_file {
namespace {

constexpr char kHeading[] =
    "# Resolved case: every key written out, presets and tables included (docs/case_files.md).\n";

/// Checks that look across sections, and the motion with its explicit start values.
void finishCase(Case& c, const CaseMotion& motion, const InitialValues& initial,
                const CaseWind& wind, Faults& faults) {
  const StartValues start = startValues(c, initial, *motion.motion, faults);
  c.motion = std::make_shared<StartMotion>(motion.motion, start, c.time.t_start);
  c.wind = windOf(c, wind, faults);
  checkTimeStep(c, faults);
  checkGrid(c, faults);
}

/// Reads all sections; what cannot be read keeps its default, with a fault.
Case readCase(Section& root, Faults& faults) {
  Case c;
  c.name = root.name("name");
  root.text("description");
  Section insect_section = root.section("insect");
  const std::string kind = insect_section.textOf("kind");
  c.mirrored = root.choice("wings", {"mirrored", "independent"}) != "independent";
  if (kind == "bare_wing" && !c.mirrored)
    faults.add("wings = independent: a bare wing is one wing; set wings to mirrored");
  const auto insect = readInsect(std::move(insect_section), c.mirrored, faults);
  if (insect) c.insect = *insect;
  const CaseWind wind =
      readFluid(root.section("fluid"), kind == "butterfly" && c.mirrored, c, faults);
  readGrid(root.section("grid"), c, faults);
  const double chord = insect ? insect->meanChord() : std::numeric_limits<double>::infinity();
  const CaseMotion motion = readMotion(root.section("motion"), kind == "bare_wing", chord, faults);
  const InitialValues initial = readInitial(root);
  c.free = readFree(root.section("free"), c.mirrored);
  readTime(root.section("time"), motion.frequency, c);
  readCoupling(root.section("coupling"), insect ? insect->meanChord() : 1.0, c, faults);
  c.guidance = readGuidance(root.section("guidance"), motion.frequency, c, faults);
  readOutput(root.section("output"), c);
  c.watchdog_s = root.number("watchdog_s", {Bound::kPositive, "s", "60 is usual"});
  root.finish();
  if (insect) checkFree(c, faults);
  if (insect) checkMirrored(c, motion, initial, faults);
  if (insect && motion.motion) checkMotion(c, motion, faults);
  c.guidance.wingbeat.dt = c.time.dt;
  if (root.clean()) checkGuidance(c, motion, faults);
  checkWind(c, wind, faults);
  if (root.clean()) finishCase(c, motion, initial, wind, faults);
  return c;
}

/// The case of a document with every layer in it; `name` is what messages call it.
Case resolvedCase(const YAML::Node& document, const std::string& name, Faults& faults) {
  Section root(document, "", faults);
  Case c = readCase(root, faults);
  faults.throwIfAny(name);
  YAML::Emitter emitter;
  emitter << root.resolved();
  c.resolved_yaml = kHeading + std::string(emitter.c_str()) + "\n";
  c.sha256 = sha256Hex(c.resolved_yaml);
  return c;
}

}  // namespace
}  // namespace monarch_flight::case_file

namespace monarch_flight {

using namespace case_file;

Case loadCase(const std::string& name_or_path, const CaseOverrides& overrides,
              const std::string& config_dir) {
  const std::string path = findCase(name_or_path, config_dir);
  Faults faults;
  const YAML::Node document = assembleCase(path, overrides, config_dir, faults);
  return resolvedCase(document, path, faults);
}

Case caseFromText(const std::string& yaml, const std::string& name, const CaseOverrides& overrides,
                  const std::string& config_dir) {
  Faults faults;
  const YAML::Node document = layeredCase(caseDocument(yaml, name), overrides, config_dir, faults);
  return resolvedCase(document, name, faults);
}

}  // namespace monarch_flight
