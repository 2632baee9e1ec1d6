#include "monarch_flight/run/checkpoints.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/csv_tables.h"
#include "monarch_flight/run/federation.h"
#include "run/case/difference.h"
#include "run/words.h"

namespace monarch_flight {
namespace {

constexpr char kCoordinator[] = "coordinator";

/// One word of a shell.
std::string forShell(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::strchr("/._-+,=@%", c) != nullptr;
  };
  if (std::all_of(text.begin(), text.end(), plain)) return text;
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + quoted + "'";
}

}  // namespace

std::string checkpointFolder(const std::string& out) { return out + "/checkpoints"; }

Checkpoints::Checkpoints(const Case& c, const std::string& out, bool resume, int ranks)
    : files_(checkpointFolder(out)),
      facts_{0, MONARCH_FLIGHT_VERSION, c.name, c.sha256, ranks},
      led_by_node_(c.guidance.kind == GuidanceKind::kNode),
      out_(out),
      case_yaml_(c.resolved_yaml),
      every_(static_cast<std::uint32_t>(c.output.checkpoint_every)) {
  parts_.push_back(kCoordinator);
  for (Role role : rolesOf(c)) parts_.push_back(roleName(role));
  if (led_by_node_) parts_.push_back(kWingbeatPart);
  if (resume) choose(c, out);
}

/// Takes the newest checkpoint that can be used.
void Checkpoints::choose(const Case& c, const std::string& out) {
  Resumption resumption;
  for (const std::uint32_t step : files_.steps()) {
    const std::string why = problemOf(step, c, out, resumption);
    if (why.empty()) {
      resumption.step = step;
      kept_ = step;
      resumption_ = resumption;
      return;
    }
    resumption.refused.push_back(why);
    refused_.push_back(step);
  }
  if (resumption.refused.empty())
    throw InputError("resume = " + out + ": " + files_.folder() +
                     " holds no checkpoint to go on from; give the folder of a run, or start a new "
                     "flight with out:=");
  std::vector<std::string> faults;  // the reasons first: they say what to do
  for (const std::string& why : resumption.refused) faults.push_back("resume: " + why);
  faults.push_back("resume = " + out + ": so none of its checkpoints can be used");
  throw InputError(faults);
}

/// Why a checkpoint cannot be used; empty: it can, and `coordinator_` holds its part.
std::string Checkpoints::problemOf(std::uint32_t step, const Case& c, const std::string& out,
                                   Resumption& resumption) {
  const std::string where = files_.path(step) + ": ";
  try {
    const CheckpointFacts facts = files_.verify(step);
    if (facts.ranks != 0 && facts.ranks != facts_.ranks)
      return where + "was made with the flow on " + std::to_string(facts.ranks) +
             " process(es), not on " + std::to_string(facts_.ranks) +
             "; give ranks:=" + std::to_string(facts.ranks);
    coordinator_ = files_.read(step, kCoordinator);
    reader_.emplace(coordinator_, files_.path(step) + "/coordinator.h5");
    std::string before;
    (*reader_)("case_yaml", before);
    const case_file::CaseDifference difference = case_file::caseDifference(before, case_yaml_);
    if (!difference.forbidden.empty())
      return where + "is of another case: " + joined(difference.forbidden) +
             "; change these keys back, or start a new flight";
    if (step > c.time.steps)
      return where + "the run is to end with step " + std::to_string(c.time.steps) +
             ", before this one; give more flaps:=";
    for (const char* table : {"flight", "iterations"}) {
      OutputMark mark;
      showMark(*reader_, table + std::string("_csv"), mark);
      const std::string why = problem(out + "/" + table + ".csv", mark);
      if (!why.empty()) return where + "is of another flight: " + why;
    }
    resumption.changed = difference.allowed;
    if (facts.version != facts_.version)
      resumption.changed.push_back("version: " + facts.version + " -> " + facts_.version);
    return "";
  } catch (const std::exception& e) {
    reader_.reset();
    return e.what();
  }
}

std::string Checkpoints::command() const {
  if (const char* known = std::getenv("MONARCH_GO_ON")) return known;  // by whoever started the run
  return "monarch fly resume:=" + forShell(out_) +
         (facts_.ranks > 1 ? " ranks:=" + std::to_string(facts_.ranks) : "") +
         (led_by_node_ ? " guidance_node:=<its program>" : "");
}

std::optional<std::uint32_t> Checkpoints::resumed() const {
  return resumption_ ? std::optional<std::uint32_t>(resumption_->step) : std::nullopt;
}

void Checkpoints::load(const ShowState& coordinator) {
  coordinator(*reader_);
  for (const std::uint32_t step : refused_) files_.refuse(step);
}

bool Checkpoints::due(std::uint32_t step, bool last) const {
  return every_ > 0 && (last || step % every_ == 0);
}

bool Checkpoints::settled(std::uint32_t step) const { return every_ == 0 || kept_ == step; }

void Checkpoints::reset() {
  for (const std::uint32_t step : files_.steps()) files_.remove(step);
  resumption_.reset();
  kept_.reset();
}

void Checkpoints::open(std::uint32_t step) { files_.open(step); }

void Checkpoints::close(std::uint32_t step, const ShowState& coordinator) {
  StateRecord record;
  StateWriter writer(record);
  std::string yaml = case_yaml_;
  writer("case_yaml", yaml);
  coordinator(writer);
  files_.write(step, kCoordinator, record);
  facts_.step = step;
  files_.close(facts_, parts_);
  kept_ = step;
}

}  // namespace monarch_flight
