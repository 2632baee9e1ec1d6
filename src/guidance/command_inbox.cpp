#include "monarch_flight/guidance/command_inbox.h"

#include <cmath>

namespace monarch_flight {
namespace {

constexpr double kBeforeAll = -1e300;
constexpr double kRounding = 1e-9;  // of a phase that stands for the beginning of a flap

}  // namespace

void CommandInbox::post(const WingbeatChange& change, bool at_once) {
  if (heard_) heard_(change);
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = Posted{change, at_once};
}

std::optional<CommandInbox::Posted> CommandInbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::optional<Posted> taken;
  taken.swap(newest_);
  return taken;
}

void PostedCommands::start() {
  inbox_->take();
  waiting_ = false;
  flap_ = kBeforeAll;
}

std::optional<WingbeatChange> PostedCommands::next(const WingbeatLevel& level) {
  if (const auto newest = inbox_->take()) {
    posted_ = *newest;
    waiting_ = true;
  }
  const double flap = std::floor(level.phase + kRounding);
  const bool begins = flap > flap_;
  flap_ = flap;
  if (!waiting_ || !(begins || posted_.at_once)) return std::nullopt;
  waiting_ = false;
  return posted_.change;
}

void PostedCommands::memory(StateVisitor& state) {
  state("inbox_waiting", waiting_);
  state("inbox_at_once", posted_.at_once);
  for (const CommandInfo& info : kCommandTable)
    state((std::string("inbox_") + info.name).c_str(), posted_.change.*info.value);
  state("inbox_flap", flap_);
}

}  // namespace monarch_flight
