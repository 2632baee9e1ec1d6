#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "monarch_flight/insect/build.h"
#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/math/errors.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

struct Stations {
  std::vector<double> y, leading, trailing;
};

/// From `file` (CSV with columns y, leading, trailing) or from the lists in `stations`; the
/// resolved case holds the numbers and, as `source`, where they came from.
Stations readStations(Section& section, Faults& faults) {
  Stations s;
  const bool has_file = section.has("file");
  if (has_file == section.has("stations")) {
    section.take("file");
    section.take("stations");
    section.fault("file", ": give either file (a CSV) or stations (lists y, leading, trailing)");
    return s;
  }
  if (!has_file) {
    section.put("source", section.has("source") ? section.text("source") : "stations in the case");
    Section lists = section.section("stations");
    s.y = lists.numbers("y", "");
    s.leading = lists.numbers("leading", "");
    s.trailing = lists.numbers("trailing", "");
    lists.finish();
    return s;
  }
  const YAML::Node file = section.take("file");
  try {
    if (!file.IsScalar()) throw InputError(section.pathOf("file") + ": must be a path; correct it");
    const NumericTable table = readCsv(file.Scalar()).select({"y", "leading", "trailing"});
    s = {table.column("y"), table.column("leading"), table.column("trailing")};
  } catch (const InputError& e) {
    faults.add(e.what());
    return s;
  }
  section.put("source", section.has("source")
                            ? section.text("source")
                            : std::filesystem::path(file.Scalar()).filename().string());
  Section lists = section.putSection("stations");
  lists.put("y", s.y);
  lists.put("leading", s.leading);
  lists.put("trailing", s.trailing);
  return s;
}

std::optional<Planform> readOutline(Section& section, bool polynomial, Faults& faults) {
  Stations s = readStations(section, faults);
  const double unit = section.number("unit", {Bound::kPositive, "m", "0.01 for a file in cm"});
  const double hinge = section.number("hinge", {Bound::kAny, "file units", "0: the line x = 0"});
  const double offset = section.number("root_offset", {Bound::kAny, "file units", "0 is usual"});
  const int order = polynomial ? section.integer("order", "6 is the published order") : 0;
  const auto span = section.maybeNumber("scale_span", {Bound::kPositive, "m", "or none"});
  const auto area = section.maybeNumber("scale_area", {Bound::kPositive, "m2", "or none"});
  if (!section.clean()) return std::nullopt;
  for (double& y : s.y) y = unit * (y + offset);
  for (double& x : s.leading) x = unit * (x - hinge);
  for (double& x : s.trailing) x = unit * (x - hinge);
  const Planform raw = polynomial ? Planform::polynomial(s.y, s.leading, s.trailing, order)
                                  : Planform::table(s.y, s.leading, s.trailing);
  if (!span && !area) return raw;
  const double wanted_span = span.value_or(raw.span());
  return raw.scaledTo(wanted_span, area.value_or(raw.area() * wanted_span / raw.span()));
}

std::optional<Planform> readSimple(Section& section, bool ellipse) {
  const double chord = section.number("chord", {Bound::kPositive, "m", "give the full chord"});
  const double span = section.number("span", {Bound::kPositive, "m", "give root to tip"});
  const double hinge = section.number("hinge", {Bound::kAny, "chords", "0.25: quarter chord"});
  const double root = section.number("root_offset", {Bound::kAny, "m", "0: root edge at the root"});
  if (!section.clean()) return std::nullopt;
  return ellipse ? Planform::ellipse(chord, span, hinge, root)
                 : Planform::rectangle(chord, span, hinge, root);
}

Cylinder readCylinder(Section& section) {
  Cylinder c;
  c.mass = section.number("mass", {Bound::kAny, "kg", ""});
  c.length = section.number("length", {Bound::kAny, "m", ""});
  c.width = section.number("width", {Bound::kAny, "m", ""});
  return c;
}

/// Optional; 0 where it is not given.
double readSweep(Section& section) {
  if (!section.has("sweep")) {
    section.take("sweep");
    return 0.0;
  }
  const double sweep = section.number("sweep", {Bound::kAny, "rad", "0: not swept"});
  if (std::abs(sweep) <= M_PI / 3.0) return sweep;
  section.fault("sweep", " = " + exactText(sweep) + " rad: must be within +-pi/3; 0: not swept");
  return 0.0;
}

}  // namespace

std::optional<Planform> readPlanform(Section section, Faults& faults) {
  const std::string type =
      section.choice("type", {"rectangle", "ellipse", "csv", "polynomial_csv"});
  std::optional<Planform> planform;
  if (type.empty()) return planform;  // the other keys depend on it
  const double sweep = readSweep(section);
  try {
    if (type == "csv" || type == "polynomial_csv") {
      planform = readOutline(section, type == "polynomial_csv", faults);
    } else {
      planform = readSimple(section, type == "ellipse");
    }
    if (planform) planform = planform->sweptBack(sweep);
  } catch (const std::invalid_argument& e) {
    faults.add(section.path() + ": " + e.what());
  }
  section.finish();
  return planform;
}

namespace {

/// Section `hinge_additions` of a wing. Of a wing of its own (`own`) keys that are not there keep
/// what `additions` has.
void readAdditions(Section section, bool own, HingeAdditions& additions) {
  const auto number = [&](const char* name, const char* unit, double& value) {
    if (!own || section.has(name))
      value = section.number(name, {Bound::kAny, unit, "0: the paper's hinge"});
  };
  const auto stop = [&](const char* name, std::optional<double>& value) {
    if (!own || section.has(name))
      value = section.maybeNumber(name, {Bound::kAny, "rad", "none: there is no stop"});
  };
  number("damping", "N m s/rad", additions.damping);
  number("cubic_stiffness", "N m/rad3", additions.cubic_stiffness);
  stop("stop_low", additions.stop_low);
  stop("stop_high", additions.stop_high);
  number("stop_stiffness", "N m/rad", additions.stop_stiffness);
  section.finish();
}

/// What one wing of two has of its own, in section `right_wing` or `left_wing`: keys that are not
/// there are those of both wings, in `wing`.
void readOwnWing(Section& insect, const std::string& key, WingParameters both, Wing& wing,
                 Faults& faults) {
  if (!insect.has(key)) return;
  Section w = insect.section(key);
  const auto own = [&w](const char* name, const char* unit, double& value) {
    if (w.has(name)) value = w.number(name, {Bound::kAny, unit, ""});
  };
  own("mass", "kg", both.mass);
  if (w.has("root")) both.root = w.vector3("root", "m");
  own("kappa", "N m/rad", both.kappa);
  own("theta_0", "rad", both.theta_0);
  if (w.has("hinge_additions")) readAdditions(w.section("hinge_additions"), true, both.additions);
  std::optional<Planform> planform = wing.planform;
  if (w.has("planform")) planform = readPlanform(w.section("planform"), faults);
  double lost = 0.0;
  own("tip_lost", "", lost);
  if (!(lost >= 0.0 && lost <= 0.9))
    w.fault("tip_lost", " = " + exactText(lost) +
                            ": must be in [0, 0.9], the share of the area that is cut off; 0 is a "
                            "whole wing");
  w.finish();
  if (!w.clean() || !planform) return;
  both.mass *= 1.0 - lost;
  try {
    wing = makeWing(both, planform->withoutTip(lost));
  } catch (const std::invalid_argument& e) {
    faults.add(w.pathOf("tip_lost") + ": " + e.what());
  }
  faults.add(wingProblems(key, wing));
}

}  // namespace

std::optional<Insect> readInsect(Section section, bool mirrored, Faults& faults) {
  const std::string kind = section.choice("kind", {"butterfly", "bare_wing"});
  const std::string name = section.name("name");
  if (kind.empty()) return std::nullopt;
  const bool bare = kind == "bare_wing";
  WingParameters wing;
  wing.beta = section.number("beta", {Bound::kAny, "rad", ""});
  Cylinder body, abdomen;
  Eigen::Vector3d joint = Eigen::Vector3d::Zero();
  if (!bare) {
    Section b = section.section("body");
    body = readCylinder(b);
    b.finish();
    Section a = section.section("abdomen");
    abdomen = readCylinder(a);
    joint = a.vector3("joint", "m");
    a.finish();
  }
  Section w = section.section("wing");
  wing.mass = w.number("mass", {Bound::kAny, "kg", ""});
  if (!bare) wing.root = w.vector3("root", "m");
  wing.kappa = w.number("kappa", {Bound::kAny, "N m/rad", ""});
  wing.theta_0 = w.number("theta_0", {Bound::kAny, "rad", ""});
  readAdditions(w.section("hinge_additions"), false, wing.additions);
  const auto planform = readPlanform(w.section("planform"), faults);
  w.finish();
  // Bounds are checked even when other keys are faulty: all faults at once.
  const Planform any = planform ? *planform : Planform::rectangle(1.0, 1.0, 0.0);
  Insect insect =
      bare ? makeBareWing(name, wing, any) : makeButterfly(name, body, abdomen, joint, wing, any);
  faults.add(insect.problems());
  for (const auto& [key, side] :
       {std::pair{"right_wing", Side::kRight}, {"left_wing", Side::kLeft}}) {
    if (section.has(key) && mirrored)
      section.fault(key,
                    ": must not be given while one wing is the mirror image of the other; set "
                    "wings to independent, or change insect/wing");
    readOwnWing(section, key, wing, insect.wings[side], faults);
  }
  section.finish();
  if (!section.clean() || !planform) return std::nullopt;
  return insect;
}

}  // namespace monarch_flight::case_file
