#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "monarch_flight/coupling/state_visitor.h"
#include "monarch_flight/run/case.h"

namespace monarch_flight {

/// How far the wings of a butterfly pass through its mid-plane, where the other wing is. The air of
/// each wing is solved alone and wings are flat, so nothing else notices. Of a wing counts what
/// lies farther out than a tenth of its span.
class MidPlane {
 public:
  explicit MidPlane(const Case& c);
  void add(const CommittedStep& step);
  void memory(StateVisitor& state);

  double depth() const { return depth_; }  ///< largest, of one wing; 0 where none passes [m]
  double share() const { return steps_ ? double(beyond_) / double(steps_) : 0; }  ///< of the steps
  /// A sentence for the reader, "" where no wing passes.
  std::string remark() const;

 private:
  const Insect insect_;
  Sides sides_;
  PerWing<std::vector<Eigen::Vector3d>> rim_;  ///< wing axes
  double depth_ = 0.0;
  std::uint64_t steps_ = 0, beyond_ = 0;
};

}  // namespace monarch_flight
