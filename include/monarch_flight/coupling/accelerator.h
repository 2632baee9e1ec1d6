#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "monarch_flight/coupling/settings.h"
#include "monarch_flight/coupling/step_model.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// A sub-iteration: one full evaluation of the air, the flight and the wing.
struct Trial {
  CouplingVector d = CouplingVector::Zero();         ///< guess d^k
  CouplingVector residual = CouplingVector::Zero();  ///< H(d^k) - d^k
  PerWing<Loads> loads;                              ///< of the air, for d^k
  /// Of the loads, where it was asked for.
  std::optional<PerWing<LoadOperator>> jacobian;
};

/// What to try next.
struct Proposal {
  CouplingVector d = CouplingVector::Zero();  ///< d^{k+1}
  double relaxation = 0.0;  ///< factor applied to the residual; 1: a whole quasi-Newton step
  /// What the air will answer for it, where the strategy knows.
  std::optional<PerWing<Loads>> loads;
};

/// Strategy that finds d = H(d) of each step from the answers H(d^k) (docs/coupling.md): the loop
/// does not know which one it uses. Increments of the attitude are rotation vectors in body axes;
/// attitudes are never added.
class Accelerator {
 public:
  virtual ~Accelerator() = default;
  /// A new fixed-point problem: the next trial is the first one of this step.
  virtual void beginStep(std::uint32_t step) = 0;
  /// Forgets everything that earlier steps taught.
  virtual void forget() {}
  /// Whether the next trial should come with the Jacobian of the loads, which costs the air
  /// `operator_cost` evaluations.
  virtual bool wantsOperator(int operator_cost) const;
  virtual Proposal advance(const Trial& trial) = 0;
  /// The last trial of the step converged; it was not advanced from.
  virtual void endStep(const Trial& last);
  /// What one step leaves to the next.
  virtual void memory(StateVisitor&) {}
};

/// d^{k+1} = d^k + omega r^k.
class ConstantRelaxation : public Accelerator {
 public:
  explicit ConstantRelaxation(double omega) : omega_(omega) {}
  void beginStep(std::uint32_t) override {}
  Proposal advance(const Trial& trial) override;

 private:
  double omega_;
};

/// Aitken's vector Delta^2 (Kuettler & Wall 2008):
/// omega_k = - omega_{k-1} r_{k-1}.(r_k - r_{k-1}) / |r_k - r_{k-1}|^2, its absolute value kept
/// within [omega_min, omega_max]; the last factor stays where the residual did not change.
class AitkenRelaxation : public Accelerator {
 public:
  AitkenRelaxation(double omega_initial, double omega_min, double omega_max);
  void beginStep(std::uint32_t step) override;
  Proposal advance(const Trial& trial) override;

 private:
  double omega_initial_, omega_min_, omega_max_;
  double omega_;
  bool has_previous_ = false;
  CouplingVector previous_;  // residual of the last sub-iteration
};

/// Interface quasi-Newton with the inverse Jacobian from least squares (Degroote et al. 2009), with
/// the differences of earlier steps used again: d^{k+1} = d^k + r^k + W alpha, where alpha
/// minimises |V alpha + r^k|, V and W holding differences of residuals and of answers, the newest
/// first; those that add nothing new to V are left out. Without any difference: relaxation by
/// omega_initial.
class IqnIls : public Accelerator {
 public:
  /// `reuse`: earlier steps whose differences are kept, 0 to kMaxReuse.
  IqnIls(double omega_initial, int reuse);
  static constexpr int kMaxReuse = 20;
  void beginStep(std::uint32_t step) override;
  void forget() override;
  Proposal advance(const Trial& trial) override;
  void endStep(const Trial& last) override;
  void memory(StateVisitor& state) override;

 private:
  static constexpr int kCapacity = 64;  // differences kept; the oldest go first
  struct Difference {
    CouplingVector residual, answer;
    int age;  // steps
  };
  void learn(const Trial& trial);
  CouplingVector correction(const CouplingVector& residual) const;

  double omega_initial_;
  int reuse_;
  std::array<Difference, kCapacity> differences_;  // newest first
  int count_ = 0;
  std::optional<Trial> previous_;
};

/// Added-mass quasi-Newton. The loads near a trial are L(d) = L^k + K (u(d) - u^k) + M (a(d) -
/// a^k), u and a being the velocity and acceleration of the wing, K and M their Jacobian
/// (LoadOperator), for each wing whose air is solved; flight and wing are the step model. Newton's
/// method solves that coupled problem to the last digit without the air; d^{k+1} is its solution
/// and L(d^{k+1}) the predicted loads. K is exact within a step of a flow that is affine; from step
/// to step it is corrected by Broyden's update with the trials of each step, and asked for again
/// every `operator_every` steps, after a step that needed more than three trials, and in every step
/// where it costs nothing.
class AddedMassNewton : public Accelerator {
 public:
  /// `model` must outlive the strategy and stand at the step.
  AddedMassNewton(const StepModel& model, double length_scale, int operator_every);
  void beginStep(std::uint32_t step) override;
  void forget() override;
  bool wantsOperator(int operator_cost) const override;
  Proposal advance(const Trial& trial) override;
  void endStep(const Trial& last) override;
  void memory(StateVisitor& state) override;

 private:
  void learn(const Trial& trial);
  void update(Side side, const Trial& trial);
  PerWing<Loads> predicted(const Trial& trial, const CouplingVector& d) const;
  CoordinateMatrix residualJacobian(const Trial& trial, const CouplingVector& base) const;
  CouplingVector toModes(const CouplingVector& d) const;
  CouplingVector fromModes(const CouplingVector& modes) const;

  const StepModel& model_;
  double length_scale_;
  int operator_every_;
  std::optional<PerWing<LoadOperator>> operator_;
  std::uint32_t step_ = 0, fetched_ = 0;  // now; when the operator came from the air
  int advances_ = 0;                      // of this step
  bool missed_ = false;                   // the last step needed more than three trials
  std::optional<Trial> previous_;
};

/// The strategy that the settings name. `model` is used by the added-mass strategy.
std::unique_ptr<Accelerator> makeAccelerator(const CouplingSettings& settings,
                                             const StepModel& model);

}  // namespace monarch_flight
