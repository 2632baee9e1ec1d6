#include "monarch_flight/run/run_outputs.h"

#include <cstdio>

namespace monarch_flight {
namespace {

// Runs `action`; adds what it throws to `failure`.
template <class Action>
void collect(std::string& failure, Action action) {
  try {
    action();
  } catch (const OutputError& e) {
    if (failure.find(e.what()) == std::string::npos)
      failure += (failure.empty() ? "" : "; ") + std::string(e.what());
  }
}

}  // namespace

RunOutputs::Files::Files(const Case& c, const RunDirectory& directory, StateVisitor* resumed)
    : flight(directory.file("flight.csv"), resumed),
      iterations(directory.file("iterations.csv"), resumed),
      summary(c) {}

RunOutputs::RunOutputs(const Case& c, const std::string& directory, Checkpoints* resumed)
    : case_(c),
      directory_(directory, estimatedOutputBytes(c), resumed && resumed->outputs()),
      files_(std::make_unique<Files>(c, directory_, resumed ? resumed->outputs() : nullptr)) {
  if (resumed && resumed->outputs())
    files_->summary.resume(*resumed->outputs(), *resumed->resumption());
  writeWhole(directory_.file("case.yaml"), c.resolved_yaml);
  std::remove(directory_.file("summary.json").c_str());  // of the part flown before
}

void RunOutputs::onStep(const CommittedStep& step) {
  files_->summary.add(step);
  files_->flight.append(step);
  files_->iterations.append(step);
}

void RunOutputs::onReset() {
  files_.reset();
  files_ = std::make_unique<Files>(case_, directory_, nullptr);
}

void RunOutputs::onCheckpoint(StateVisitor& state) {
  files_->flight.onCheckpoint(state);
  files_->iterations.onCheckpoint(state);
  files_->summary.onCheckpoint(state);
}

void RunOutputs::onEnd(const std::string& failure) {
  std::string all = failure;
  collect(all, [&] { files_->flight.file().finish(); });
  collect(all, [&] { files_->iterations.file().finish(); });
  const std::string before_summary = all;
  collect(all, [&] {
    writeWhole(directory_.file("summary.json"), files_->summary.json(before_summary));
  });
  if (all != failure) throw OutputError(all);
}

}  // namespace monarch_flight
