#include <algorithm>

#include "monarch_flight/coupling/accelerator.h"

namespace monarch_flight {
namespace {

// A difference is new when this share of it is not a combination of newer ones: below lies the
// noise of a nonlinear problem's older differences.
constexpr double kIndependent = 1e-3;

}  // namespace

IqnIls::IqnIls(double omega_initial, int reuse)
    : omega_initial_(omega_initial), reuse_(std::clamp(reuse, 0, kMaxReuse)) {}

void IqnIls::beginStep(std::uint32_t) {
  previous_.reset();
  for (int i = 0; i < count_; ++i) ++differences_[static_cast<std::size_t>(i)].age;
  while (count_ > 0 && differences_[static_cast<std::size_t>(count_ - 1)].age > reuse_) --count_;
}

void IqnIls::forget() {
  previous_.reset();
  count_ = 0;
}

void IqnIls::learn(const Trial& trial) {
  if (previous_) {
    const CouplingVector change = trial.residual - previous_->residual;
    if (change.squaredNorm() > 0.0) {
      count_ = std::min(count_ + 1, kCapacity);
      std::move_backward(differences_.begin(), differences_.begin() + (count_ - 1),
                         differences_.begin() + count_);
      differences_[0] = {change, trial.d - previous_->d + change, 0};
    }
  }
  previous_ = trial;
}

// Modified Gram-Schmidt on V, newest first; W takes the same combinations.
CouplingVector IqnIls::correction(const CouplingVector& residual) const {
  std::array<CouplingVector, kCoordinates> basis, answers;
  std::size_t rank = 0;
  CouplingVector left = residual, step = CouplingVector::Zero();
  for (int i = 0; i < count_ && rank < kCoordinates; ++i) {
    const Difference& difference = differences_[static_cast<std::size_t>(i)];
    CouplingVector v = difference.residual, w = difference.answer;
    const double length = v.norm();
    for (std::size_t j = 0; j < rank; ++j) {
      const double share = basis[j].dot(v);
      v -= share * basis[j];
      w -= share * answers[j];
    }
    const double rest = v.norm();
    if (rest < kIndependent * length) continue;
    basis[rank] = v / rest;
    answers[rank] = w / rest;
    const double share = basis[rank].dot(left);
    left -= share * basis[rank];
    step -= share * answers[rank];
    ++rank;
  }
  return step;
}

Proposal IqnIls::advance(const Trial& trial) {
  learn(trial);
  if (count_ == 0) return {trial.d + omega_initial_ * trial.residual, omega_initial_, {}};
  return {trial.d + trial.residual + correction(trial.residual), 1.0, {}};
}

void IqnIls::endStep(const Trial& last) { learn(last); }

void IqnIls::memory(StateVisitor& state) {
  constexpr int n = kCoordinates, kRow = 2 * n + 1;
  std::array<Eigen::Matrix<double, kRow, 1>, kCapacity> rows;
  for (std::size_t i = 0; i < kCapacity; ++i) {
    const Difference& d = differences_[i];
    const bool used = static_cast<int>(i) < count_;
    rows[i].setZero();
    if (used) rows[i] << d.residual, d.answer, static_cast<double>(d.age);
  }
  state("iqn_ils_count", count_);
  state.numbers("iqn_ils_differences", rows[0].data(), kRow * std::size_t{kCapacity});
  if (!state.loading()) return;
  for (std::size_t i = 0; i < kCapacity; ++i) {
    differences_[i] = {rows[i].head<n>(), rows[i].segment<n>(n), static_cast<int>(rows[i][2 * n])};
  }
}

}  // namespace monarch_flight
