#include <sstream>

#include "monarch_flight/math/errors.h"
#include "run/case/parts.h"

namespace monarch_flight::case_file {
namespace {

/// Of a wind from the side.
std::string sideFault(double wind) {
  return " = " + exactText(wind) + " m/s: must be 0" + kMirrored +
         "set it to 0, or choose wings independent";
}

/// A velocity, of which `mirrored` forbids y.
Eigen::Vector3d readVelocity(Section& section, const std::string& key, bool mirrored) {
  const Eigen::Vector3d wind_I = section.vector3(key, "m/s");
  if (mirrored && wind_I.y() != 0.0) {
    section.fault(key, "[1]" + sideFault(wind_I.y()));
  }
  return wind_I;
}

/// `flight`, which is also what a missing key means, or a vector of any length but zero.
std::optional<Eigen::Vector3d> readDirection(Section& section, Faults& faults) {
  constexpr char kKey[] = "direction", kFlight[] = "flight";
  if (!section.has(kKey) || section.textOf(kKey) == kFlight) {
    section.take(kKey);
    section.put(kKey, std::string(kFlight));
    return std::nullopt;
  }
  const std::size_t before = faults.count();
  const Eigen::Vector3d direction = section.vector3(kKey, "");
  if (faults.count() == before && direction.isZero(0.0)) {
    section.fault(kKey, " = [0, 0, 0]: must not be zero; give a direction, or flight");
  }
  return direction;
}

CaseGust readGust(Section& section, bool mirrored, Faults& faults) {
  CaseGust gust;
  const std::string kind = section.choice("kind", {"time", "place"});
  if (kind.empty()) return gust;
  gust.in_place = kind == "place";
  if (gust.in_place) {
    gust.start = section.number("start", {Bound::kAny, "m", "how far ahead the gust begins"});
    gust.extent = section.number("length", {Bound::kPositive, "m", "how deep the gust is"});
    gust.direction = readDirection(section, faults);
  } else {
    gust.start = section.number("start", {Bound::kAny, "s", "when the gust begins"});
    gust.extent = section.number("duration", {Bound::kPositive, "s", "how long the gust lasts"});
  }
  gust.amplitude = readVelocity(section, "amplitude", mirrored);
  section.finish();
  return gust;
}

/// The first row of a table that blows from the side.
void checkSide(const NumericTable& table, Faults& faults) {
  const std::vector<double> side = table.column("wy");
  for (std::size_t i = 0; i < side.size(); ++i) {
    if (side[i] == 0.0) continue;
    faults.add(table.name + ": row " + std::to_string(i + 1) + ", column wy" + sideFault(side[i]));
    return;
  }
}

std::shared_ptr<const WindSeries> readSeries(Section& section, bool mirrored, Faults& faults) {
  if (!section.has("file") && (!section.has("rows") || section.textOf("rows") == "none")) {
    section.take("rows");
    section.put("rows", std::string("none"));
    return nullptr;
  }
  const std::size_t before = faults.count();
  try {
    const NumericTable table = readRows(section, WindSeries::columns());
    if (faults.count() != before) return nullptr;
    const auto series = std::make_shared<const WindSeries>(table);
    if (mirrored) checkSide(table, faults);
    return series;
  } catch (const InputError& e) {
    faults.add(e.what());
  }
  return nullptr;
}

/// Where the motion heads to at t_start, horizontally.
Eigen::Vector3d headingOf(const BodyState& body, std::size_t gust, Faults& faults) {
  const Eigen::Vector3d heading(body.v.x(), body.v.y(), 0.0);
  if (heading.isZero(0.0)) {
    faults.add("fluid/wind/gusts[" + std::to_string(gust) +
               "]/direction = flight: the motion has no horizontal velocity at time/t_start: must "
               "be a vector; give [x, y, z]");
    return Eigen::Vector3d::UnitX();
  }
  return heading.normalized();
}

}  // namespace

CaseWind readWind(Section& fluid, bool mirrored, Faults& faults) {
  CaseWind wind;
  if (!fluid.isMap("wind")) {
    wind.steady = readVelocity(fluid, "wind", mirrored);
    return wind;
  }
  Section section = fluid.section("wind");
  if (section.has("steady")) {
    wind.steady = readVelocity(section, "steady", mirrored);
  } else {
    section.take("steady");
    section.put("steady", std::vector<double>{0.0, 0.0, 0.0});
  }
  for (Section& gust : section.sections("gusts")) {
    wind.gusts.push_back(readGust(gust, mirrored, faults));
  }
  wind.series = readSeries(section, mirrored, faults);
  section.finish();
  return wind;
}

void checkWind(const Case& c, const CaseWind& wind, Faults& faults) {
  if (!wind.series || c.time.steps == 0) return;
  const double begin = wind.series->tBegin(), end = wind.series->tEnd();
  const double last = c.time.time(c.time.steps), rounding = 1e-9 * (end - begin);
  if (c.time.t_start >= begin - rounding && last <= end + rounding) return;
  std::ostringstream text;
  text.precision(9);
  text << "fluid/wind: the table reaches from " << begin << " to " << end
       << " s: must cover the run from " << c.time.t_start << " to " << last
       << " s; give a longer table, or change time/t_start or the run's length";
  faults.add(text.str());
}

std::shared_ptr<const WindModel> windOf(const Case& c, const CaseWind& wind, Faults& faults) {
  auto steady = std::make_shared<SteadyWind>(wind.steady);
  if (wind.gusts.empty() && !wind.series) return steady;
  std::vector<std::shared_ptr<const WindModel>> parts{std::move(steady)};
  const BodyState body = c.motion->at(c.time.t_start).body;
  for (std::size_t i = 0; i < wind.gusts.size(); ++i) {
    const CaseGust& gust = wind.gusts[i];
    if (!gust.in_place) {
      parts.push_back(std::make_shared<TimeGust>(gust.start, gust.extent, gust.amplitude));
      continue;
    }
    const Eigen::Vector3d direction =
        gust.direction ? gust.direction->normalized() : headingOf(body, i, faults);
    parts.push_back(std::make_shared<PlaceGust>(body.x + gust.start * direction, direction,
                                                gust.extent, gust.amplitude));
  }
  if (wind.series) parts.push_back(wind.series);
  return std::make_shared<WindSum>(std::move(parts));
}

}  // namespace monarch_flight::case_file
