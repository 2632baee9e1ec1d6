#pragma once
#include <optional>
#include <string>
#include <vector>

namespace monarch_flight {

/// A key of a run, as config/keys.yaml explains it.
struct RunKey {
  std::string name;
  std::string type;
  std::vector<std::string> choices;
  std::optional<double> above;  ///< a number is larger
  double from = 0.0;            ///< a count is at least that
  std::optional<double> to;     ///< and at most that
  std::vector<std::string> of;  ///< who takes it: fly, program, launch, server
  std::string override;         ///< its place in a case file, as fluid/solver; empty: it is none

  bool takenBy(const std::string& taker) const;
  /// What a value must be, in words, where this one is not; empty where it is allowed.
  std::string fault(const std::string& value) const;
};

/// Reads the table keys.yaml of a config folder, once for each folder. Throws InputError when it is
/// missing or damaged.
const std::vector<RunKey>& runKeys(const std::string& config_dir);
/// The key of this name, or null.
const RunKey* findKey(const std::vector<RunKey>& keys, const std::string& name);

}  // namespace monarch_flight
