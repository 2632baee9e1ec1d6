#include "monarch_flight/ros_io/audience.h"

#include <iostream>

#include "monarch_flight/ros_io/master.h"

namespace monarch_flight {
namespace {

constexpr std::chrono::seconds kPatience{20};
constexpr std::chrono::milliseconds kBetweenQuestions{200};

}  // namespace

Audience::Audience(const RunNames& names, bool awaited) : names_(names), ready_(!awaited) {}

bool Audience::ready() {
  if (ready_) return true;
  const auto now = Clock::now();
  if (!begin_) {
    begin_ = now;
    std::cout << "waiting for rviz, at most " << kPatience.count() << " s" << std::endl;
  }
  if (now - asked_ < kBetweenQuestions) return false;
  asked_ = now;
  if (rvizListens()) return ready_ = true;
  if (now - *begin_ < kPatience) return false;
  std::cout << "rviz has not come within " << kPatience.count()
            << " s: the flight begins without it" << std::endl;
  return ready_ = true;
}

/// Its displays subscribe all at once.
bool Audience::rvizListens() const { return listens(names_.topic("../rviz"), names_.topic("")); }

}  // namespace monarch_flight
