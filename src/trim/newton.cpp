#include "monarch_flight/trim/newton.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <vector>

#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNear = 0.3;  // periodicity within which the targets lead

/// A better point: closer to periodic flight or, near it, closer to the targets.
bool better(const TrimResidual& next, const TrimResidual& now, double weight) {
  if (weight > 0.0) {
    const auto merit = [weight](const TrimResidual& r) {
      return std::hypot(weight * r.periodicity.norm(), r.targets.norm());
    };
    return merit(next) < merit(now);
  }
  const double before = now.periodicity.norm(), after = next.periodicity.norm();
  if (after < 0.9 * before) return true;
  if (next.targets.size() == 0) return after < before;
  return after < std::max(before, kNear) && next.targets.norm() < now.targets.norm();
}

/// f at all points, `threads` of them at a time.
std::vector<std::optional<TrimResidual>> evaluateAll(const TrimFunction& f,
                                                     const std::vector<VectorXd>& points,
                                                     int threads) {
  std::vector<std::optional<TrimResidual>> results(points.size());
  const auto width = static_cast<std::size_t>(std::max(threads, 1));
  for (std::size_t first = 0; first < points.size(); first += width) {
    std::vector<std::future<void>> running;
    const std::size_t end = std::min(points.size(), first + width);
    for (std::size_t i = first; i < end; ++i) {
      running.push_back(std::async(std::launch::async, [&, i] { results[i] = f(points[i]); }));
    }
    for (auto& one : running) one.get();
  }
  return results;
}

/// Least squares of |a + A p|^2 + damping |p|^2 with p within bounds: unknowns that leave them are
/// held there.
VectorXd boundedLeastSquares(const MatrixXd& A, const VectorXd& a, double damping,
                             const VectorXd& low, const VectorXd& high) {
  const Index q = A.cols();
  VectorXd p = VectorXd::Zero(q);
  std::vector<bool> held(static_cast<std::size_t>(q), false);
  for (Index pass = 0; pass <= q; ++pass) {
    std::vector<Index> open;
    for (Index i = 0; i < q; ++i) {
      if (!held[static_cast<std::size_t>(i)]) open.push_back(i);
    }
    if (open.empty()) break;
    const auto count = static_cast<Index>(open.size());
    MatrixXd M = MatrixXd::Zero(A.rows() + count, count);
    VectorXd rhs = VectorXd::Zero(A.rows() + count);
    rhs.head(A.rows()) = -a;
    for (Index i = 0; i < q; ++i) {
      if (held[static_cast<std::size_t>(i)]) rhs.head(A.rows()) -= A.col(i) * p(i);
    }
    for (Index k = 0; k < count; ++k) {
      M.col(k).head(A.rows()) = A.col(open[static_cast<std::size_t>(k)]);
      M(A.rows() + k, k) = std::sqrt(damping);
    }
    const VectorXd solution = M.completeOrthogonalDecomposition().solve(rhs);  // the smallest one
    bool changed = false;
    for (Index k = 0; k < count; ++k) {
      const Index i = open[static_cast<std::size_t>(k)];
      p(i) = std::clamp(solution(k), low(i), high(i));
      if (p(i) == solution(k)) continue;
      held[static_cast<std::size_t>(i)] = true;
      changed = true;
    }
    if (!changed) break;
  }
  return p;
}

/// Keeps every unknown's change within `limit`, and parameters within their bounds.
VectorXd bounded(VectorXd step, const VectorXd& at, Index n, double limit,
                 const NewtonSettings& settings) {
  const double largest = step.cwiseAbs().maxCoeff();
  if (largest > limit) step *= limit / largest;
  for (Index i = n; i < step.size(); ++i) {
    step(i) = std::clamp(step(i), settings.lower(i - n) - at(i), settings.upper(i - n) - at(i));
  }
  return step;
}

bool done(const NewtonResult& r, const VectorXd& step, Index n, const NewtonSettings& settings) {
  if (settings.least_squares) return step.cwiseAbs().maxCoeff() <= settings.step_tolerance;
  if (r.residual.periodicity.cwiseAbs().maxCoeff() > settings.tolerance) return false;
  if (step.size() == n) return true;
  return step.tail(step.size() - n).cwiseAbs().maxCoeff() <= settings.step_tolerance;
}

void update(MatrixXd& J, const VectorXd& step, const TrimResidual& before,
            const TrimResidual& after) {
  const VectorXd change = after.stacked() - before.stacked();
  J += (change - J * step) * step.transpose() / step.squaredNorm();
}

/// Whether a trial tells of the map near by: a flight that tumbles has other slopes.
bool isNear(const TrimResidual& trial, const TrimResidual& at) {
  constexpr double kFar = 4.0;
  return trial.stacked().norm() < kFar * at.stacked().norm();
}

/// Shortens steps until one is better; nothing when none is. Broyden's method learns from every
/// flight near by, so its next step also has another direction. `limit` bounds this and the next
/// step.
std::optional<TrimResidual> search(const TrimFunction& f, NewtonResult& r, VectorXd& step,
                                   double& limit, const NewtonSettings& settings) {
  const Index n = r.residual.periodicity.size();
  for (int k = 0; k <= settings.max_halvings; ++k) {
    step = bounded(step, r.unknowns, n, limit, settings);
    auto trial = f(r.unknowns + step);
    ++r.evaluations;
    if (trial && settings.broyden && isNear(*trial, r.residual)) {
      update(r.jacobian, step, r.residual, *trial);
    }
    if (trial && better(*trial, r.residual, settings.weight)) {
      limit = std::min(2.0 * limit, settings.max_step);
      return trial;
    }
    limit = 0.5 * step.cwiseAbs().maxCoeff();
    if (settings.broyden) step = trimStep(r.jacobian, r.residual, r.unknowns, settings, limit);
  }
  return std::nullopt;
}

}  // namespace

VectorXd TrimResidual::stacked() const {
  VectorXd all(periodicity.size() + targets.size());
  all << periodicity, targets;
  return all;
}

MatrixXd differenceJacobian(const TrimFunction& f, const VectorXd& at, const TrimResidual& residual,
                            const NewtonSettings& settings, int& evaluations) {
  const Index n = residual.periodicity.size();
  const double d = settings.difference;
  std::vector<VectorXd> points;
  for (Index i = 0; i < at.size(); ++i) {
    // Parameters stay within their ranges; ranges are wider than no difference at all.
    const double low = i < n ? at(i) - d : std::max(at(i) - d, settings.lower(i - n));
    const double high = i < n ? at(i) + d : std::min(at(i) + d, settings.upper(i - n));
    VectorXd point = at;
    point(i) = settings.central || high - at(i) >= at(i) - low ? high : low;
    points.push_back(point);
    if (!settings.central) continue;
    point(i) = low;
    points.push_back(point);
  }
  const auto results = evaluateAll(f, points, settings.threads);
  evaluations += static_cast<int>(points.size());
  const VectorXd middle = residual.stacked();
  MatrixXd J(middle.size(), at.size());
  const std::size_t per = settings.central ? 2 : 1;
  for (Index i = 0; i < at.size(); ++i) {
    const std::size_t k = per * static_cast<std::size_t>(i);
    if (!results[k] || (settings.central && !results[k + 1])) {
      throw NumericalError("trim: the flight fails for a small change of unknown " +
                           std::to_string(i + 1) + "; start closer to a periodic flight");
    }
    const VectorXd other = settings.central ? results[k + 1]->stacked() : middle;
    const double from = settings.central ? points[k + 1](i) : at(i);
    J.col(i) = (results[k]->stacked() - other) / (points[k](i) - from);
  }
  return J;
}

/// Least squares of periodicity, weighted, and targets over all unknowns within the limit.
VectorXd jointStep(const MatrixXd& jacobian, const TrimResidual& residual, const VectorXd& unknowns,
                   const NewtonSettings& settings, double limit) {
  const Index n = residual.periodicity.size(), q = unknowns.size() - n;
  MatrixXd A = jacobian;
  VectorXd a = residual.stacked();
  A.topRows(n) *= settings.weight;
  a.head(n) *= settings.weight;
  VectorXd low = VectorXd::Constant(n + q, -limit), high = VectorXd::Constant(n + q, limit);
  low.tail(q) = low.tail(q).cwiseMax(settings.lower - unknowns.tail(q));
  high.tail(q) = high.tail(q).cwiseMin(settings.upper - unknowns.tail(q));
  return boundedLeastSquares(A, a, settings.damping, low, high);
}

VectorXd trimStep(const MatrixXd& jacobian, const TrimResidual& residual, const VectorXd& unknowns,
                  const NewtonSettings& settings, double limit) {
  const Index n = residual.periodicity.size(), m = residual.targets.size();
  const Index q = unknowns.size() - n;
  if (settings.weight > 0.0) return jointStep(jacobian, residual, unknowns, settings, limit);
  const auto states = jacobian.topLeftCorner(n, n).completeOrthogonalDecomposition();
  VectorXd step(n + q);
  VectorXd s0 = states.solve(-residual.periodicity);
  if (q == 0) return s0;
  const MatrixXd along = states.solve(-jacobian.topRightCorner(n, q));  // of states, per parameter
  VectorXd p = VectorXd::Zero(q);
  if (m > 0) {
    const auto C = jacobian.bottomLeftCorner(m, n);
    p = boundedLeastSquares(jacobian.bottomRightCorner(m, q) + C * along, residual.targets + C * s0,
                            settings.damping, settings.lower - unknowns.tail(q),
                            settings.upper - unknowns.tail(q));
  }
  step << s0 + along * p, p;
  return step;
}

NewtonResult solveTrim(const TrimFunction& f, const VectorXd& start, const NewtonSettings& settings,
                       MatrixXd jacobian,
                       const std::function<void(const NewtonResult&)>& accepted) {
  NewtonResult r;
  r.unknowns = start;
  const auto first = f(start);
  r.evaluations = 1;
  if (!first) throw NumericalError("trim: the flight from the start fails; start closer");
  r.residual = *first;
  r.jacobian = std::move(jacobian);
  const Index n = r.residual.periodicity.size();
  if (r.jacobian.size() > 0 &&
      (r.jacobian.cols() != start.size() || r.jacobian.rows() != r.residual.stacked().size()))
    throw NumericalError("trim: the Jacobian given is of another search; leave it out");
  double limit = settings.max_step;  // of a step
  for (;; ++r.iterations) {
    accepted(r);
    if (r.jacobian.size() == 0 || !settings.broyden) {
      if (!settings
               .central) {  // the run-in has taken the last flap's shape: differences start there
        if (const auto again = f(r.unknowns)) r.residual = *again;
        ++r.evaluations;
      }
      r.jacobian = differenceJacobian(f, r.unknowns, r.residual, settings, r.evaluations);
    }
    VectorXd step = trimStep(r.jacobian, r.residual, r.unknowns, settings, limit);
    // A step that is short only because the last ones failed does not tell of a minimum.
    const VectorXd free = trimStep(r.jacobian, r.residual, r.unknowns, settings, settings.max_step);
    r.converged = done(r, free, n, settings);
    if (r.converged || r.iterations == settings.max_iterations) break;
    const auto next = search(f, r, step, limit, settings);
    if (!next) {
      r.reason = "no step reduces the residual further";
      return r;
    }
    r.unknowns += step;
    r.residual = *next;
  }
  r.reason = r.converged ? "converged" : "most iterations reached";
  return r;
}

}  // namespace monarch_flight
