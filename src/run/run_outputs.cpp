#include "monarch_flight/run/run_outputs.h"

#include <cstdio>

namespace monarch_flight {
namespace {

void writeWhole(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

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

RunOutputs::RunOutputs(const Case& c, const std::string& directory, StateVisitor* resumed)
    : directory_(directory, estimatedOutputBytes(c), resumed != nullptr),
      flight_(directory_.file("flight.csv"), resumed),
      iterations_(directory_.file("iterations.csv"), resumed),
      summary_(c) {
  writeWhole(directory_.file("case.yaml"), c.resolved_yaml);
  std::remove(directory_.file("summary.json").c_str());  // of the part flown before
}

RunOutputs::RunOutputs(const Case& c, const std::string& directory)
    : RunOutputs(c, directory, nullptr) {}

RunOutputs::RunOutputs(const Case& c, const std::string& directory, Checkpoints& checkpoints)
    : RunOutputs(c, directory, checkpoints.outputs()) {
  if (checkpoints.resumption()) summary_.resume(*checkpoints.outputs(), *checkpoints.resumption());
}

void RunOutputs::onCheckpoint(StateVisitor& state) {
  flight_.onCheckpoint(state);
  iterations_.onCheckpoint(state);
  summary_.onCheckpoint(state);
}

void RunOutputs::onStep(const CommittedStep& step) {
  summary_.add(step);
  flight_.append(step);
  iterations_.append(step);
}

void RunOutputs::onEnd(const std::string& failure) {
  std::string all = failure;
  collect(all, [&] { flight_.file().finish(); });
  collect(all, [&] { iterations_.file().finish(); });
  const std::string before_summary = all;
  collect(all, [&] { writeWhole(directory_.file("summary.json"), summary_.json(before_summary)); });
  if (all != failure) throw OutputError(all);
}

}  // namespace monarch_flight
