#include "monarch_flight/trim/trim.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <mutex>
#include <ostream>

#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/seconds_since.h"

namespace monarch_flight {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Between dimensionless unknowns and points, and the residual at them.
class Search {
 public:
  Search(const FlapMap& map, const TrimOptions& options, const TrimPoint& start)
      : map_(map), options_(options), point_(start) {}

  TrimPoint point(const VectorXd& y) const {
    TrimPoint p = point_;
    const FlapState scales = trimScales();
    const auto& active = map_.active();
    for (std::size_t i = 0; i < active.size(); ++i) {
      p.state(active[i]) = y(static_cast<Index>(i)) * scales(active[i]);
    }
    for (std::size_t i = 0; i < map_.parameters().size(); ++i) {
      p.parameters(static_cast<Index>(i)) =
          y(static_cast<Index>(active.size() + i)) * map_.parameters()[i].scale;
    }
    return p;
  }

  VectorXd unknowns(const TrimPoint& p) const {
    const auto& active = map_.active();
    VectorXd y(static_cast<Index>(active.size() + map_.parameters().size()));
    for (std::size_t i = 0; i < active.size(); ++i) {
      y(static_cast<Index>(i)) = p.state(active[i]) / trimScales()(active[i]);
    }
    for (std::size_t i = 0; i < map_.parameters().size(); ++i) {
      y(static_cast<Index>(active.size() + i)) =
          p.parameters(static_cast<Index>(i)) / map_.parameters()[i].scale;
    }
    return y;
  }

  std::optional<TrimResidual> residual(const VectorXd& y) {
    const Flight flight = map_.fly(point(y), options_.horizon);
    flown_ += options_.horizon + map_.runIn();
    if (!flight.complete || flight.flaps.empty()) return std::nullopt;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      recent_.emplace_back(y, flight.flaps);
    }
    return residualOf(flight.flaps);
  }

  TrimResidual residualOf(const std::vector<Flap>& flaps) const {
    TrimResidual r;
    const FlapState change = (flaps[0].end - flaps[0].start).cwiseQuotient(trimScales());
    r.periodicity.resize(static_cast<Index>(map_.active().size()));
    for (std::size_t i = 0; i < map_.active().size(); ++i) {
      r.periodicity(static_cast<Index>(i)) = change(map_.active()[i]);
    }
    r.targets.resize(static_cast<Index>(options_.targets.size() * flaps.size()));
    Index row = 0;
    for (const Flap& flap : flaps) {
      for (const TrimTarget& target : options_.targets) {
        r.targets(row++) = (target.of(flap) - target.value) / target.tolerance;
      }
    }
    return r;
  }

  /// The flaps that were flown from y; from now on the run-in flies like the first of them, but for
  /// a horizon, over which another run-in would grow into another flight.
  const std::vector<Flap>& accept(const VectorXd& y) {
    for (const auto& [at, flaps] : recent_) {
      if (at == y) flaps_ = flaps;
    }
    recent_.clear();
    if (options_.horizon == 1) point_.shape = flaps_.front().shape;
    return flaps_;
  }

  int flown() const { return flown_; }

 private:
  const FlapMap& map_;
  const TrimOptions& options_;
  TrimPoint point_;
  std::vector<Flap> flaps_;
  std::mutex mutex_;
  std::vector<std::pair<VectorXd, std::vector<Flap>>> recent_;
  std::atomic<int> flown_{0};
};

void checkStart(const FlapMap& map, const TrimPoint& start) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < map.parameters().size(); ++i) {
    const TrimParameter& p = map.parameters()[i];
    const double value = start.parameters(static_cast<Index>(i));
    if (value >= p.low && value <= p.high) continue;
    faults.push_back("fit " + p.name + " = " + std::to_string(p.low) + " to " +
                     std::to_string(p.high) + " " + p.unit + ": must hold the case's value " +
                     std::to_string(value) + "; widen the range or change the case");
  }
  if (!faults.empty()) throw InputError(faults);
}

void logIteration(std::ostream& log, const NewtonResult& r, const std::vector<Flap>& flaps) {
  log << "iteration " << r.iterations << ": residual "
      << r.residual.periodicity.cwiseAbs().maxCoeff();
  if (r.residual.targets.size() > 0) log << ", targets " << r.residual.targets.norm();
  log << "; evaluations " << r.evaluations;
  for (const Flap& flap : flaps) {
    log << (flaps.size() > 1 ? ";\n  climb " : "; climb ") << flap.climb / kDegree << " deg, "
        << flap.speed << " m/s, theta_B mean " << flap.theta_B_mean / kDegree << " swing "
        << flap.theta_B_swing / kDegree << " deg";
  }
  log << std::endl;
}

}  // namespace

double TrimTarget::of(const Flap& flap) const {
  switch (kind) {
    case kClimb:
      return flap.climb;
    case kSpeed:
      return flap.speed;
    case kPitch:
      return flap.theta_B_mean;
    default:
      return flap.theta_B_swing;
  }
}

const char* TrimTarget::name(Kind kind) {
  constexpr const char* kNames[] = {"climb", "speed", "pitch", "swing"};
  return kNames[kind];
}

std::vector<FloquetMode> floquet(const Eigen::MatrixXd& periodicity_jacobian) {
  const Index n = periodicity_jacobian.rows();
  const Eigen::MatrixXd monodromy =
      periodicity_jacobian.leftCols(n) + Eigen::MatrixXd::Identity(n, n);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(monodromy);
  std::vector<FloquetMode> modes;
  for (Index i = 0; i < n; ++i) {
    Eigen::VectorXcd mode = solver.eigenvectors().col(i);
    Index largest = 0;
    mode.cwiseAbs().maxCoeff(&largest);
    const std::complex<double> unit = mode(largest);
    mode /= unit;
    modes.push_back({solver.eigenvalues()(i), mode});
  }
  std::stable_sort(modes.begin(), modes.end(), [](const FloquetMode& a, const FloquetMode& b) {
    return std::abs(a.multiplier) > std::abs(b.multiplier);
  });
  return modes;
}

Eigen::MatrixXd overHorizon(const Eigen::MatrixXd& jacobian, Index n, Index m, int horizon) {
  const Index known = m > 0 ? (jacobian.rows() - n) / m : 1, q = jacobian.cols() - n;
  if (known < 1 || q < 0 || jacobian.rows() != n + known * m) {
    throw InputError("jacobian: " + std::to_string(jacobian.rows()) + " x " +
                     std::to_string(jacobian.cols()) +
                     ": must have rows of states and whole flaps; give that of a like trim");
  }
  Eigen::MatrixXd next = Eigen::MatrixXd::Identity(n + q, n + q);  // state and parameters
  next.topRows(n) += jacobian.topRows(n);
  Eigen::MatrixXd J(n + horizon * m, n + q);
  J.topRows(n) = jacobian.topRows(n);
  for (Index k = 0; k < horizon; ++k) {
    auto flap = J.middleRows(n + k * m, m);
    if (k < known) {
      flap = jacobian.middleRows(n + k * m, m);
    } else {
      flap = J.middleRows(n + (k - 1) * m, m) * next;
    }
  }
  return J;
}

TrimResult trim(const Case& c, const std::string& config_dir, const TrimOptions& options,
                std::ostream& log) {
  const auto begin = std::chrono::steady_clock::now();
  const FlapMap map(c, config_dir, options.parameters, options.run_in);
  TrimPoint start = map.start();
  if (options.start) start.state = *options.start;
  checkStart(map, start);
  Search search(map, options, start);
  NewtonSettings settings = options.newton;
  const auto q = static_cast<Index>(options.parameters.size());
  settings.lower.resize(q);
  settings.upper.resize(q);
  for (Index i = 0; i < q; ++i) {
    const TrimParameter& p = options.parameters[static_cast<std::size_t>(i)];
    settings.lower(i) = p.low / p.scale;
    settings.upper(i) = p.high / p.scale;
  }
  TrimResult result;
  const auto complete = [&](const NewtonResult& r) {
    result.newton = r;
    result.point = search.point(r.unknowns);
    result.floquet = floquet(r.jacobian.topRows(static_cast<Index>(map.active().size())));
    result.flaps_flown = search.flown();
    result.wall_s = secondsSince(begin);
  };
  const auto accepted = [&](const NewtonResult& r) {
    result.flaps = search.accept(r.unknowns);
    logIteration(log, r, result.flaps);
    if (r.jacobian.size() == 0 || !options.better) return;
    complete(r);
    options.better(result);
  };
  complete(solveTrim([&](const VectorXd& y) { return search.residual(y); }, search.unknowns(start),
                     settings, options.jacobian, accepted));
  return result;
}

}  // namespace monarch_flight
