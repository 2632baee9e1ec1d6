#include "monarch_flight/run/inverse_dynamics.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "monarch_flight/flight/multibody_dynamics.h"
#include "monarch_flight/math/angle.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/output_file.h"

namespace monarch_flight {
namespace {

/// Columns of a flight.csv, in the order in which requiredAt() takes them.
const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"t", "x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"};
    for (const char* name : {"theta_B", "qw", "qx", "qy", "qz"}) all.emplace_back(name);
    for (const char* name : {"p", "q", "r", "p_dot", "q_dot", "r_dot"}) all.emplace_back(name);
    for (const char* side : {"", "_L"}) {
      const std::string pitch = side[0] == '\0' ? "theta_R" : "theta_L";
      for (const std::string& angle :
           {std::string("phi") + side, std::string("psi") + side, pitch}) {
        for (const char* rate : {"", "_dot", "_ddot"}) all.push_back(angle + rate);
      }
      for (const char* name : {"rest_angle", "fx", "fy", "fz", "mx", "my", "mz"})
        all.push_back(std::string(name) + side);
    }
    for (const char* name : {"theta_A", "theta_A_dot", "theta_A_ddot"}) all.emplace_back(name);
    return all;
  }();
  return names;
}

/// The numbers of a row, one after the other.
class RowReader {
 public:
  explicit RowReader(const std::vector<double>& row) : next_(row.begin()) {}
  double number() { return *next_++; }
  Coordinate coordinate() {
    const double q = number(), qd = number();
    return {q, qd, number()};
  }
  Eigen::Vector3d vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }

 private:
  std::vector<double>::const_iterator next_;
};

BodyState bodyAt(RowReader& row) {
  BodyState body;
  body.x = row.vector();
  body.v = row.vector();
  body.a = row.vector();
  body.pitch.q = row.number();
  const double w = row.number();
  const Eigen::Vector3d v = row.vector();
  body.q_IB = Quaternion(w, v.x(), v.y(), v.z());
  body.Omega_B = row.vector();
  body.Omega_dot_B = row.vector();
  return body;
}

RequiredLoads requiredAt(const MultibodyDynamics& dynamics, double beta,
                         const std::vector<double>& numbers) {
  RowReader row(numbers);
  RequiredLoads required;
  required.t = row.number();
  const BodyState body = bodyAt(row);
  JointAngles angles;
  PerWing<Loads> air;
  for (Side side : kSides) {
    angles.wings[side].phi = row.coordinate();
    angles.wings[side].psi = row.coordinate();
    angles.wings[side].theta = required.wings[side].theta = row.coordinate();
    required.wings[side].rest_angle = row.number();
    air[side].force_pressure = row.vector();
    air[side].moment_pressure = row.vector();
  }
  angles.theta_A = row.coordinate();
  const InsectMotion motion = insectMotion(beta, body, angles);
  const Vector15d all = dynamics.inertialForce(motion) - dynamics.gravityForce(motion) -
                        dynamics.airForce(motion, air);
  required.force = all.segment<3>(0);
  required.moment = all.segment<3>(3);
  required.wings.right.torque = all.segment<3>(6);
  required.wings.left.torque = axialImage(all.segment<3>(9));
  required.abdomen = all(13);
  return required;
}

/// Share of the variance of `torque` that `model` explains.
double explained(const Eigen::VectorXd& torque, const Eigen::VectorXd& model) {
  const double variance = (torque.array() - torque.mean()).matrix().squaredNorm();
  return variance > 0.0 ? 1.0 - (torque - model).squaredNorm() / variance : 1.0;
}

double rms(const std::vector<RequiredLoads>& rows, Eigen::Vector3d RequiredLoads::*vector,
           int component) {
  double sum = 0.0;
  for (const RequiredLoads& row : rows) sum += std::pow((row.*vector)(component), 2);
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

/// Where only one wing was solved the flight stays in the plane.
void printBody(const std::vector<RequiredLoads>& rows, bool mirrored, std::ostream& out) {
  const auto print = [&](const char* name, Eigen::Vector3d RequiredLoads::*vector, int component,
                         const char* unit) {
    char text[60];
    std::snprintf(text, sizeof text, "%s %.3g %s", name, rms(rows, vector, component), unit);
    out << text;
  };
  const auto force = &RequiredLoads::force, moment = &RequiredLoads::moment;
  out << "required besides air and gravity, rms: ";
  print("force x", force, 0, "N, ");
  if (!mirrored) print("force y", force, 1, "N, ");
  print("force z", force, 2, "N, ");
  if (!mirrored) print("roll moment", moment, 0, "N m, ");
  print("pitch moment", moment, 1, "N m");
  if (!mirrored) print(", yaw moment", moment, 2, "N m");
  out << '\n';
}

void printHinge(const HingeFit& fit, const Wing& wing, const char* of, std::ostream& out) {
  char text[700];
  std::snprintf(
      text, sizeof text,
      "hinge torque of %s wing: rms about its mean %.3g N m, mean power %.3g W\n"
      "  nearest spring:            kappa %.3g N m/rad, theta_0 %.1f deg: explains %.0f %%\n"
      "  nearest spring and damper: kappa %.3g N m/rad, theta_0 %.1f deg, damping %.3g N m s/rad: "
      "explains %.0f %%\n"
      "  the case has               kappa %.3g N m/rad, theta_0 %.1f deg\n",
      of, fit.torque_rms, fit.power, fit.spring_kappa, fit.spring_theta_0 / kDegree,
      100.0 * fit.spring_share, fit.kappa, fit.theta_0 / kDegree, fit.damping,
      100.0 * fit.damped_share, wing.kappa, wing.theta_0 / kDegree);
  out << text;
}

void printSummary(const std::vector<RequiredLoads>& rows, const Case& c, std::ostream& out) {
  printBody(rows, c.mirrored, out);
  for (Side side : c.sides()) {
    const char* of = c.mirrored ? "one" : side == Side::kRight ? "the right" : "the left";
    printHinge(fitHinge(rows, side), c.insect.wings[side], of, out);
  }
}

}  // namespace

std::vector<RequiredLoads> requiredLoads(const Case& c, const NumericTable& flight) {
  if (c.insect.bare_wing) {
    throw InputError("insect/kind = bare_wing: inverse dynamics need a body; fly a butterfly");
  }
  const NumericTable table = flight.select(columns());
  const MultibodyDynamics dynamics(c.insect, c.gravity);
  std::vector<RequiredLoads> rows;
  rows.reserve(table.rows.size());
  for (const auto& row : table.rows) rows.push_back(requiredAt(dynamics, c.insect.beta, row));
  return rows;
}

HingeFit fitHinge(const std::vector<RequiredLoads>& rows, Side side) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(n, 3);
  Eigen::VectorXd torque(n);
  HingeFit fit;
  for (Eigen::Index i = 0; i < n; ++i) {
    const HingeLoad& hinge = rows[static_cast<std::size_t>(i)].wings[side];
    A.row(i) << hinge.rest_angle - hinge.theta.q, 1.0, -hinge.theta.qd;
    torque(i) = hinge.torque.y();
    fit.power += torque(i) * hinge.theta.qd / static_cast<double>(n);
  }
  if (n < 3 || A.col(0).maxCoeff() - A.col(0).minCoeff() < 1e-9) {
    throw InputError(
        "inverse dynamics: " + std::to_string(n) +
        " rows, or a wing that does not pitch: a hinge cannot be fitted; give more of a "
        "flight in which " +
        (side == Side::kRight ? "theta_R" : "theta_L") + " changes");
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
  out << "t,theta_R,theta_R_dot,wing_x,wing_y,wing_z,abdomen,force_x,force_z,pitch,"
         "theta_L,theta_L_dot,wing_x_L,wing_y_L,wing_z_L,force_y,roll,yaw\n";
  out << std::setprecision(9);
  for (const RequiredLoads& row : rows) {
    const auto& [right, left] = row.wings;
    out << row.t << ',' << right.theta.q << ',' << right.theta.qd;
    for (double value :
         {right.torque.x(), right.torque.y(), right.torque.z(), row.abdomen, row.force.x(),
          row.force.z(), row.moment.y(), left.theta.q, left.theta.qd, left.torque.x(),
          left.torque.y(), left.torque.z(), row.force.y(), row.moment.x(), row.moment.z()})
      out << ',' << value;
    out << '\n';
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
