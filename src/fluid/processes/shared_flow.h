#pragma once
#include <memory>

#include "fluid/flow/flow.h"
#include "fluid/loads/load_operator.h"

namespace monarch_flight::fluid::processes {

/// The flow solver on several processes, as process 0 sees it: every call is told to the others,
/// which make the same call on their slab (`serve`). A failure that all share (wrong input,
/// numerics) is thrown here; one of a process alone (no memory) ends them all with its reason on
/// stderr, here when the program ends; so does one that hangs (peer_watch.h).
class SharedFlow : public FluidModel {
 public:
  /// watchdog_s: limit of one exchange with the fluid as a whole [s], of which a wait of one
  /// process for another may take four fifths (ten times that where the exchange may take ten times
  /// as long: set-up, save, restore, the whole field); 0: waits have no limit.
  SharedFlow(const Grid& grid, const Air& air, double reference_length, double courant_limit,
             MPI_Comm comm, double watchdog_s = 0.0, int threads = 1);

  void start(const WingMotion& motion, double dt) override;
  Loads evaluate(const WingMotion& next) override;
  /// By unit evaluations: exact, for within a step the loads are affine in the wall's velocity.
  Loads linearise(const WingMotion& next, LoadOperator& jacobian) override {
    return loads::affineLinearise(*this, next, jacobian);
  }
  int operatorCost() const override { return loads::kAffineEvaluations; }
  void commit() override;
  std::vector<char> save() const override;
  void restore(const std::vector<char>& bytes) override;
  Matrix6d addedMass() const override { return flow_->addedMass(); }
  FluidReport report() const override { return flow_->report(); }
  long cells() const override { return flow_->cells(); }
  SurfacePressure surfacePressure() const override;
  FlowPicture flowPicture(std::size_t limit) const override;
  std::shared_ptr<const FlowField> flowField() const override;

  /// What every process but 0 does until `dismiss`.
  static void serve(MPI_Comm comm);
  static void dismiss(MPI_Comm comm);

 private:
  MPI_Comm comm_;
  std::unique_ptr<NavierStokes> flow_;
};

}  // namespace monarch_flight::fluid::processes
