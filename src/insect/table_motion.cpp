#include "monarch_flight/insect/table_motion.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "insect/smooth_spline.h"
#include "insect/table_checks.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

Coordinate coordinate(const SmoothSpline::Value& v, int i) { return {v.q[i], v.qd[i], v.qdd[i]}; }

/// Rotation part of the body state from the unnormalised quaternion spline p: q = p / |p|.
/// omega = 2 vec(p* p') / |p|^2; alpha = 2 vec(p* p'') / |p|^2 - 2 (p . p') / |p|^2 omega.
void setAttitude(BodyState& body, const Eigen::Vector4d& p, const Eigen::Vector4d& pd,
                 const Eigen::Vector4d& pdd) {
  const double n2 = p.squaredNorm();
  const auto vectorPart = [&p](const Eigen::Vector4d& d) -> Eigen::Vector3d {
    return p[0] * d.tail<3>() - d[0] * p.tail<3>() - p.tail<3>().cross(d.tail<3>());
  };
  body.q_IB = Quaternion(p[0], p[1], p[2], p[3]).normalized();
  body.Omega_B = 2.0 / n2 * vectorPart(pd);
  body.Omega_dot_B = 2.0 / n2 * vectorPart(pdd) - 2.0 * p.dot(pd) / n2 * body.Omega_B;
  setPitchAngle(body);
}

}  // namespace

const std::vector<std::string>& TableMotion::columnsOf(TableKind kind) {
  static const std::vector<std::string> wing{"t", "x", "y", "z", "qw", "qx", "qy", "qz"};
  static const std::vector<std::string> body{"t",   "x",   "y",       "z",      "theta_B",
                                             "phi", "psi", "theta_R", "theta_A"};
  return kind == TableKind::kWing ? wing : body;
}

TableMotion::TableMotion(const NumericTable& given, TableKind kind, double length) : kind_(kind) {
  NumericTable table = given.select(columnsOf(kind));
  const std::size_t n = table.rows.size();
  const std::vector<std::string> faults = checkTable(table, kind, length);
  if (!faults.empty()) throw InputError(faults);

  std::vector<double> times;
  Eigen::MatrixXd samples(table.columns.size() - 1, n);
  for (std::size_t i = 0; i < n; ++i) {
    times.push_back(table.rows[i][0]);
    for (Eigen::Index k = 0; k < samples.rows(); ++k) samples(k, i) = table.rows[i][k + 1];
  }
  t_begin_ = times.front();
  t_end_ = times.back();
  spline_ = std::make_unique<const SmoothSpline>(times, samples);
}

TableMotion::~TableMotion() = default;

PrescribedState TableMotion::at(double t) const {
  const double rounding = 1e-9 * (t_end_ - t_begin_);
  if (!(t >= t_begin_ - rounding && t <= t_end_ + rounding)) {
    std::ostringstream text;
    text.precision(9);
    text << "t = " << t << " s lies outside the motion table: " << t_begin_ << " to " << t_end_
         << " s";
    throw std::out_of_range(text.str());
  }
  const SmoothSpline::Value v = spline_->at(t);
  PrescribedState state;
  state.body.x = v.q.head<3>();
  state.body.v = v.qd.head<3>();
  state.body.a = v.qdd.head<3>();
  if (kind_ == TableKind::kWing) {
    setAttitude(state.body, v.q.tail<4>(), v.qd.tail<4>(), v.qdd.tail<4>());
    return state;
  }
  state.body = withPitch(state.body, coordinate(v, 3));
  const WingAngles wing{coordinate(v, 4), coordinate(v, 5), coordinate(v, 6)};
  state.angles = {{wing, wing}, coordinate(v, 7)};
  return state;
}

}  // namespace monarch_flight
