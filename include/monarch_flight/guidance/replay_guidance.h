#pragma once
#include <memory>
#include <string>
#include <vector>

#include "monarch_flight/coupling/guidance.h"
#include "monarch_flight/insect/numeric_table.h"

namespace monarch_flight {

/// Flies again what guidance prescribed in a recorded flight, bit for bit: joints, rest angle, wind
/// and report of each level from a table, the body's prescribed coordinates from the motion.
class ReplayGuidance : public Guidance {
 public:
  /// `table`: columns() of a flight.csv, one row a level from level 0 on.
  ReplayGuidance(std::shared_ptr<const PrescribedMotion> motion,
                 std::shared_ptr<const NumericTable> table)
      : motion_(std::move(motion)), table_(std::move(table)) {}
  PrescribedState start(double t) override { return at(0, t); }
  PrescribedState next(const GuidanceInput& input) override { return at(input.step, input.t); }
  GuidanceReport report() const override { return report_; }

  /// The columns of flight.csv that a replay needs, in the order of the table.
  static const std::vector<std::string>& columns();

 private:
  PrescribedState at(std::uint32_t step, double t);

  std::shared_ptr<const PrescribedMotion> motion_;
  std::shared_ptr<const NumericTable> table_;
  GuidanceReport report_;
};

}  // namespace monarch_flight
