#include "monarch_flight/run/inverse_dynamics.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/output_file.h"

namespace monarch_flight {
namespace {

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = {"t",
                                                 "x",
                                                 "y",
                                                 "z",
                                                 "vx",
                                                 "vy",
                                                 "vz",
                                                 "ax",
                                                 "ay",
                                                 "az",
                                                 "theta_B",
                                                 "theta_B_dot",
                                                 "theta_B_ddot",
                                                 "theta_R",
                                                 "theta_R_dot",
                                                 "theta_R_ddot",
                                                 "fx",
                                                 "fy",
                                                 "fz",
                                                 "mx",
                                                 "my",
                                                 "mz"};
  return names;
}

Eigen::Vector3d vectorAt(const std::vector<double>& row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2]};
}

RequiredLoads requiredAt(const MultibodyDynamics& dynamics, const Case& c,
                         const std::vector<double>& row) {
  const Coordinate pitch{row[10], row[11], row[12]};
  PrescribedState state = c.motion->at(row[0]);
  BodyState body = withPitch(state.body, pitch);
  body.x = vectorAt(row, 1);
  body.v = vectorAt(row, 4);
  body.a = vectorAt(row, 7);
  JointAngles angles = state.angles;
  const Coordinate theta{row[13], row[14], row[15]};
  for (Side side : kSides) angles.wings[side].theta = theta;
  Loads right;
  right.force_pressure = vectorAt(row, 16);
  right.moment_pressure = vectorAt(row, 19);
  const InsectMotion motion = insectMotion(c.insect.beta, body, angles);
  const Vector15d required = dynamics.inertialForce(motion) - dynamics.gravityForce(motion) -
                             dynamics.airForce(motion, {right, right});
  return {row[0],      theta,      required.segment<3>(6), required(13), required(0),
          required(2), required(4)};
}

/// Share of the variance of `torque` that `model` explains.
double explained(const Eigen::VectorXd& torque, const Eigen::VectorXd& model) {
  const double variance = (torque.array() - torque.mean()).matrix().squaredNorm();
  return variance > 0.0 ? 1.0 - (torque - model).squaredNorm() / variance : 1.0;
}

double rms(const std::vector<RequiredLoads>& rows, double RequiredLoads::*value) {
  double sum = 0.0;
  for (const RequiredLoads& row : rows) sum += row.*value * row.*value;
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

void printSummary(const std::vector<RequiredLoads>& rows, const Case& c, std::ostream& out) {
  const HingeFit fit = fitHinge(rows);
  const double kDegrees = 180.0 / M_PI;
  char text[900];
  std::snprintf(
      text, sizeof text,
      "required besides air and gravity, rms: force x %.3g N, force z %.3g N, pitch moment %.3g N "
      "m\n"
      "hinge torque of one wing: rms about its mean %.3g N m, mean power %.3g W\n"
      "  nearest spring:            kappa %.3g N m/rad, theta_0 %.1f deg: explains %.0f %%\n"
      "  nearest spring and damper: kappa %.3g N m/rad, theta_0 %.1f deg, damping %.3g N m s/rad: "
      "explains %.0f %%\n"
      "  the case has               kappa %.3g N m/rad, theta_0 %.1f deg\n",
      rms(rows, &RequiredLoads::force_x), rms(rows, &RequiredLoads::force_z),
      rms(rows, &RequiredLoads::pitch), fit.torque_rms, fit.power, fit.spring_kappa,
      fit.spring_theta_0 * kDegrees, 100.0 * fit.spring_share, fit.kappa, fit.theta_0 * kDegrees,
      fit.damping, 100.0 * fit.damped_share, c.insect.wings.right.kappa,
      c.insect.wings.right.theta_0 * kDegrees);
  out << text;
}

}  // namespace

std::vector<RequiredLoads> requiredLoads(const Case& c, const NumericTable& flight) {
  if (c.insect.bare_wing) {
    throw InputError("insect/kind = bare_wing: inverse dynamics need a body; fly a butterfly");
  }
  if (!c.mirrored) {
    throw InputError(
        "wings = independent: inverse dynamics take both wings to do the same; fly with wings "
        "mirrored");
  }
  const NumericTable table = flight.select(columns());
  const MultibodyDynamics dynamics(c.insect, c.gravity);
  std::vector<RequiredLoads> rows;
  rows.reserve(table.rows.size());
  for (const auto& row : table.rows) rows.push_back(requiredAt(dynamics, c, row));
  return rows;
}

HingeFit fitHinge(const std::vector<RequiredLoads>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(n, 3);
  Eigen::VectorXd torque(n);
  HingeFit fit;
  for (Eigen::Index i = 0; i < n; ++i) {
    const RequiredLoads& row = rows[static_cast<std::size_t>(i)];
    A.row(i) << -row.theta_R.q, 1.0, -row.theta_R.qd;
    torque(i) = row.wing.y();
    fit.power += torque(i) * row.theta_R.qd / static_cast<double>(n);
  }
  if (n < 3 || A.col(0).maxCoeff() - A.col(0).minCoeff() < 1e-9) {
    throw InputError(
        "inverse dynamics: " + std::to_string(n) +
        " rows, or a wing that does not pitch: a hinge cannot be fitted; give more of a "
        "flight in which theta_R changes");
  }
  const Eigen::Vector2d spring = A.leftCols(2).colPivHouseholderQr().solve(torque);
  const Eigen::Vector3d damped = A.colPivHouseholderQr().solve(torque);
  fit.spring_kappa = spring(0);
  fit.spring_theta_0 = spring(1) / spring(0);
  fit.spring_share = explained(torque, A.leftCols(2) * spring);
  fit.kappa = damped(0);
  fit.theta_0 = damped(1) / damped(0);
  fit.damping = damped(2);
  fit.damped_share = explained(torque, A * damped);
  fit.torque_rms =
      std::sqrt((torque.array() - torque.mean()).matrix().squaredNorm() / static_cast<double>(n));
  return fit;
}

void writeRequiredLoads(const std::vector<RequiredLoads>& rows, std::ostream& out) {
  out << "t,theta_R,theta_R_dot,wing_x,wing_y,wing_z,abdomen,force_x,force_z,pitch\n";
  char text[300];
  for (const RequiredLoads& r : rows) {
    std::snprintf(text, sizeof text, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", r.t,
                  r.theta_R.q, r.theta_R.qd, r.wing.x(), r.wing.y(), r.wing.z(), r.abdomen,
                  r.force_x, r.force_z, r.pitch);
    out << text;
  }
}

void runInverseDynamics(const std::string& run, double from, double to,
                        const std::string& config_dir, std::ostream& out) {
  namespace fs = std::filesystem;
  const fs::path case_file = fs::path(run) / "case.yaml", table_file = fs::path(run) / "flight.csv";
  if (!fs::exists(case_file) || !fs::exists(table_file)) {
    throw InputError("run:=" + run +
                     ": must hold case.yaml and flight.csv; give the folder of a flight");
  }
  const Case c = loadCase(case_file.string(), {}, config_dir);
  NumericTable flight = readCsv(table_file.string());
  const int t = flight.find("t");
  const double period = c.time.period > 0.0 ? c.time.period : c.time.dt;
  std::vector<std::vector<double>> window;
  for (std::size_t i = 1; t >= 0 && i < flight.rows.size();
       ++i) {  // no loads are known at the start
    const double flap = (flight.rows[i][static_cast<std::size_t>(t)] - c.time.t_start) / period;
    if (flap >= from - 1e-9 && (to < 0.0 || flap < to - 1e-9)) window.push_back(flight.rows[i]);
  }
  if (window.size() < 3) {
    const std::string end = to < 0.0 ? "" : " to:=" + std::to_string(to);
    throw InputError("from:=" + std::to_string(from) + end + ": holds " +
                     std::to_string(window.size()) +
                     " steps of the flight; take a window of it in flaps");
  }
  flight.rows = std::move(window);
  const std::vector<RequiredLoads> rows = requiredLoads(c, flight);
  std::ostringstream text;
  writeRequiredLoads(rows, text);
  printSummary(rows, c, out);
  writeWhole((fs::path(run) / "inverse_dynamics.csv").string(), text.str());
}

}  // namespace monarch_flight
