#pragma once
#include <array>
#include <vector>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/trim/flap_map.h"

namespace monarch_flight {

/// Keeps states, positions and accelerations of a flight and cuts it into flaps behind a run-in.
class FlapRecorder : public StepSink {
 public:
  FlapRecorder(const TimeGrid& time, std::uint32_t run_in_steps, int harmonics);
  void onStep(const CommittedStep& step) override;
  void onReset() override;
  void onEnd(const std::string&) override {}
  std::vector<Flap> flaps() const;
  /// Time derivative of the state at every level.
  const std::vector<FlapState>& accelerations() const { return accelerations_; }

 private:
  Flap flap(std::size_t first, std::size_t last) const;

  TimeGrid time_;
  std::size_t run_in_;
  int harmonics_;
  std::vector<FlapState> states_, accelerations_;
  std::array<std::vector<double>, 4> q_;    // x, z, theta_B, theta_R
  std::vector<double> sideways_, heading_;  // y, yaw
};

/// Series of one flap's samples of x, z, theta_B, theta_R (both ends included).
FlapShape flapShape(const std::array<std::vector<double>, 4>& samples, const TimeGrid& time,
                    int harmonics);

/// Flies a case in this process, recorded, without pictures.
Flight flyCase(Case c, FlapRecorder& recorder);

}  // namespace monarch_flight
