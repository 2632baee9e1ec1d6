// Against the published histories of the FWUAV group (test/data/fwuav_*.csv): linear momentum,
// joint torques and wing pitch along them, and body attitude with their moment row in place of
// ours.
#include <fstream>
#include <iomanip>

#include "dynamics/ode.h"
#include "dynamics/rows.h"
#include "insect/smooth_spline.h"
#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kBound = 1e-8;

/// A published history: file, stroke plane, hinge (kappa 0: no spring), names of its columns.
struct History {
  const char* name;
  const char* file;
  double beta, kappa, theta_0;
  bool passive;
};
constexpr History kHover{"hover", "fwuav_hover.csv", -0.008717319725232837, 0.0, 0.0, false};
constexpr History kPassive{"passive pitch",     "fwuav_passive_pitch_hover.csv",
                           0.6283185307179586,  4.071433271890511e-05,
                           -0.4184977496324338, true};

/// Masses and inertias of test/data/monarch_morphology_fwuav.json as the histories use them; the
/// wing's mass centre has half the plate's spanwise distance there.
Insect publishedInsect(const History& history) {
  Insect insect{history.name,
                false,
                0,
                Matrix3d::Zero(),
                0,
                0,
                0,
                0,
                {},
                {},
                {},
                0,
                0,
                0,
                Planform::rectangle(0.0209048, 0.060997, 0.25)};
  insect.m_B = 1.485e-4;
  insect.J_B = Vector3d(5.988708e-10, 2.9481420375e-09, 2.9481420375e-09).asDiagonal();
  insect.right.m = 2.51e-05;
  insect.right.nu = {-0.004437781694645591, 0.015176339407718576, 0.0};
  insect.right.J << 2.756824953134474e-08, 2.4957003913366034e-09, 0.0, 2.4957003913366034e-09,
      2.579907487057571e-09, 0.0, 0.0, 0.0, 3.0148157018402314e-08;
  insect.right.mu = {0.0, 0.00284, 0.0};
  insect.left = mirrored(insect.right);
  insect.abdomen.m = 1.092e-4;
  insect.abdomen.nu = {-0.00869, 0.0, 0.0};
  insect.abdomen.J =
      Vector3d(1.87879965e-10, 1.1089084142499997e-08, 1.1089084142499997e-08).asDiagonal();
  insect.abdomen.mu = {-0.007315, 0.0, 0.0};
  insect.beta = history.beta;
  insect.kappa = history.kappa;
  insect.theta_0 = history.theta_0;
  return insect;
}

class Rows {
 public:
  explicit Rows(const std::string& path) : table_(readCsv(path)) {}
  std::size_t size() const { return table_.rows.size(); }
  double operator()(std::size_t row, const std::string& column) const {
    const int i = table_.find(column);
    if (i < 0) throw std::runtime_error(table_.name + ": no column " + column);
    return table_.rows[row][static_cast<std::size_t>(i)];
  }
  Vector3d vector(std::size_t row, const std::string& name, int first = 1) const {
    const auto at = [&](int i) { return (*this)(row, name + "_" + std::to_string(first + i)); };
    return {at(0), at(1), at(2)};
  }

 private:
  NumericTable table_;
};

/// Joint angles with phi'' and psi'' recovered from the published derivative of Omega_R.
JointAngles jointAngles(const Vector3d& euler, const Vector3d& euler_dot, const Vector3d& rate_dot,
                        const Coordinate& theta_A) {
  JointAngles angles{{euler.x(), euler_dot.x(), 0.0},
                     {euler.z(), euler_dot.z(), 0.0},
                     {euler.y(), euler_dot.y(), 0.0},
                     theta_A};
  const Vector3d rest = rate_dot - wingRateDerivative(angles);  // linear in second derivatives
  const double ct = std::cos(angles.theta.q), st = std::sin(angles.theta.q);
  angles.phi.qdd = (rest.x() * ct + rest.z() * st) / std::cos(angles.psi.q);
  angles.psi.qdd = rest.x() * st - rest.z() * ct;
  angles.theta.qdd = rest.y() - angles.phi.qdd * std::sin(angles.psi.q);
  return angles;
}

struct Sample {
  BodyState body;
  JointAngles right, left;
  std::array<Vector6d, 3> loads;
  std::array<Vector3d, 3> torques;  // on right wing, left wing, abdomen, body axes, no spring
  InsectMotion motion(double beta) const {
    InsectMotion m = insectMotion(beta, body, right);
    m.joints[1] = insectMotion(beta, body, left).joints[1];
    return m;
  }
};

Sample sampleOf(const History& history, const Rows& rows, std::size_t n) {
  Sample s;
  const bool p = history.passive;
  const int first = p ? 4 : 1;
  for (int j = 0; j < 3; ++j) {
    s.body.R_IB.row(j) = rows.vector(n, p ? "X" : "Rcm", first + 3 * j);
  }
  s.body.R_IB.transposeInPlace();  // published column by column
  s.body.v = p ? rows.vector(n, "X", 13) : rows.vector(n, "xdot");
  s.body.a = p ? rows.vector(n, "X_dot", 13) : rows.vector(n, "xddot");
  s.body.Omega_B = p ? rows.vector(n, "X", 16) : rows.vector(n, "W");
  s.body.Omega_dot_B = p ? rows.vector(n, "X_dot", 16) : rows.vector(n, "Wdot");
  const std::string bar = p ? "_" : "";
  s.right = jointAngles(
      rows.vector(n, "Euler" + bar + "R"), rows.vector(n, "Euler" + bar + "R" + bar + "dot"),
      rows.vector(n, "W_R" + bar + "dot"),
      {rows(n, p ? "theta_A" : "thetaA"), rows(n, "W_A_2"), rows(n, p ? "W_A_dot_2" : "W_Adot_2")});
  s.left = s.right;
  if (p) s.left.theta = {rows(n, "X_20"), rows(n, "X_22"), rows(n, "X_dot_22")};
  s.loads[0] << rows.vector(n, "F_R"), rows.vector(n, "M_R");
  s.loads[1] << rows.vector(n, "F_L"), rows.vector(n, "M_L");
  s.loads[2].setZero();
  for (int i = 0; i < 3; ++i)
    s.torques[static_cast<std::size_t>(i)] = rows.vector(n, "tau", 1 + 3 * i);
  return s;
}

/// Linear momentum in balance. The published attitudes leave SO(3) by up to 1.1e-7; their equations
/// have the mass itself, not m R R^T, in front of x'', so R^-1 stands for R^T here.
Vector3d momentumResidual(const MultibodyDynamics& dynamics, const Insect& insect,
                          const Sample& s) {
  InsectMotion m = s.motion(insect.beta);
  const Matrix3d& R = m.body.R_IB;
  const Vector3d a = m.body.a - kGravity * Vector3d::UnitZ();
  m.body.a = R.transpose().inverse() * R.inverse() * a;
  return dynamics.inertialForce(m).head<3>() + insect.m_B * (a - m.body.a) -
         dynamics.appliedForce(m, s.loads).head<3>();
}

/// Rows 4-6 as published: sum mu x Q F for the air and -sum Q tau for the joints.
Vector3d publishedMomentRow(const MultibodyDynamics& dynamics, const Insect& insect,
                            const Sample& s) {
  const InsectMotion m = s.motion(insect.beta);
  Vector3d row = (dynamics.inertialForce(m) - dynamics.gravityForce(m)).segment<3>(3);
  const Vector3d mus[] = {insect.right.mu, insect.left.mu, insect.abdomen.mu};
  for (std::size_t i = 0; i < 3; ++i) {
    row -= mus[i].cross(m.joints[i].Q * s.loads[i].head<3>()) - s.torques[i];
  }
  return row;
}

DynamicsRows alongHistory(const History& history, const std::string& folder) {
  const Insect insect = publishedInsect(history);
  const MultibodyDynamics dynamics(insect, kGravity);
  const WingPitchSolver hinge(insect, kGravity, Newmark());
  const Rows rows(folder + "/" + history.file);
  double force = 0, force_scale = 0, torque = 0, torque_scale = 0, moment = 0, moment_scale = 0;
  double pitch = 0, pitch_scale = 0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const Sample s = sampleOf(history, rows, n);
    force = std::max(force, momentumResidual(dynamics, insect, s).norm());
    force_scale = std::max(force_scale, rows.vector(n, "f_a").norm());
    const InsectMotion m = s.motion(insect.beta);
    const Vector15d rest =
        dynamics.inertialForce(m) - dynamics.gravityForce(m) - dynamics.appliedForce(m, s.loads);
    Vector3d joints = Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3d own = rest.segment<3>(6 + 3 * static_cast<int>(i));
      if (i < 2) own.y() += insect.kappa * ((i == 0 ? s.right : s.left).theta.q - insect.theta_0);
      torque = std::max(torque, (m.joints[i].Q * own - s.torques[i]).norm());
      torque_scale = std::max(torque_scale, s.torques[i].norm());
      joints += s.torques[i];
    }
    moment = std::max(moment, publishedMomentRow(dynamics, insect, s).norm());
    moment_scale = std::max(moment_scale, joints.norm());
    if (!history.passive) continue;
    Loads loads;
    loads.force_pressure = s.loads[0].head<3>();
    loads.moment_pressure = s.loads[0].tail<3>();
    const double theta = rows(n, "X_dot_21");
    pitch = std::max(pitch, std::abs(hinge.acceleration(s.body, s.right, loads) - theta));
    pitch_scale = std::max(pitch_scale, std::abs(theta));
  }
  const std::string of = std::string(" (") + history.name + ")";
  const std::string count = std::to_string(rows.size()) + " published rows";
  DynamicsRows result = {{"published", "linear momentum, residual / largest force" + of, count,
                          force, force_scale, force / force_scale, kBound},
                         {"published", "joint torques, difference / largest" + of, count, torque,
                          torque_scale, torque / torque_scale, kBound},
                         {"published", "body moment with their row, residual / largest" + of, count,
                          moment, moment_scale, moment / moment_scale, kBound}};
  if (history.passive) {
    result.push_back({"published", "wing pitch acceleration, difference / largest" + of, count,
                      pitch, pitch_scale, pitch / pitch_scale, kBound});
  }
  return result;
}

/// Longitudinal hover under the published loads as functions of time; state x', z', theta_B,
/// theta_B'.
class HoverUnderLoads {
 public:
  HoverUnderLoads(const std::string& folder, bool published_row)
      : insect_(publishedInsect(kHover)),
        dynamics_(insect_, kGravity),
        published_row_(published_row),
        rows_(folder + "/fwuav_hover_longitudinal.csv"),
        spline_(splineOf(rows_)) {}

  const Rows& rows() const { return rows_; }

  void operator()(const OdeState& y, OdeState& dydt, double t) const {
    const SmoothSpline::Value v = spline_.at(t);
    const auto angle = [&](int i) { return Coordinate{v.q(i), v.qd(i), v.qdd(i)}; };
    const JointAngles angles{angle(1), angle(3), angle(2), angle(0)};
    Loads right;
    right.force_pressure = v.q.segment<3>(4);
    right.moment_pressure = v.q.segment<3>(7);
    const Loads left = mirrored(right);
    std::array<Vector6d, 3> loads;
    loads[0] << right.force(), right.moment();
    loads[1] << left.force(), left.moment();
    loads[2].setZero();
    const Vector3d a = accelerations(y, angles, loads);
    dydt = {a(0), a(1), y[3], a(2)};
  }

 private:
  static SmoothSpline splineOf(const Rows& rows) {
    const char* names[] = {"thetaA", "EulerR_1", "EulerR_2", "EulerR_3", "F_R_1",
                           "F_R_2",  "F_R_3",    "M_R_1",    "M_R_2",    "M_R_3"};
    std::vector<double> t;
    Eigen::MatrixXd values(10, static_cast<Eigen::Index>(rows.size()));
    for (std::size_t n = 0; n < rows.size(); ++n) {
      t.push_back(rows(n, "t"));
      for (int i = 0; i < 10; ++i) values(i, static_cast<Eigen::Index>(n)) = rows(n, names[i]);
    }
    return SmoothSpline(t, values);
  }

  /// Rows x, z and pitch of the balance; affine in (x'', z'', theta_B'').
  Vector3d balance(const OdeState& y, const JointAngles& angles,
                   const std::array<Vector6d, 3>& loads, const Vector3d& a) const {
    Sample s;
    s.body.v = {y[0], 0.0, y[1]};
    s.body = withPitch(s.body, {y[2], y[3], a(2)});
    s.body.a = {a(0), 0.0, a(1)};
    s.right = s.left = angles;
    s.loads = loads;
    const InsectMotion m = s.motion(insect_.beta);
    const Vector15d rest =
        dynamics_.inertialForce(m) - dynamics_.gravityForce(m) - dynamics_.appliedForce(m, loads);
    if (!published_row_) return {rest(0), rest(2), rest(4)};
    for (std::size_t i = 0; i < 3; ++i) {
      s.torques[i] = m.joints[i].Q * rest.segment<3>(6 + 3 * static_cast<int>(i));
    }
    return {rest(0), rest(2), publishedMomentRow(dynamics_, insect_, s).y()};
  }

  Vector3d accelerations(const OdeState& y, const JointAngles& angles,
                         const std::array<Vector6d, 3>& loads) const {
    const Vector3d zero = balance(y, angles, loads, Vector3d::Zero());
    Matrix3d A;
    const double probe[] = {1.0, 1.0, 100.0};
    for (int i = 0; i < 3; ++i) {
      A.col(i) = (balance(y, angles, loads, probe[i] * Vector3d::Unit(i)) - zero) / probe[i];
    }
    return -A.inverse() * zero;
  }

  Insect insect_;
  MultibodyDynamics dynamics_;
  bool published_row_;
  Rows rows_;
  SmoothSpline spline_;
};

/// Body pitch over the published hover with either moment row, and a table of the three curves.
DynamicsRows attitude(const DynamicsFolders& folders) {
  const HoverUnderLoads theirs(folders.data, true), ours(folders.data, false);
  const Rows& rows = theirs.rows();
  const auto published = [&](std::size_t n) {
    return OdeState{rows(n, "xdot_1"), rows(n, "xdot_3"), rows(n, "thetaB"), rows(n, "W_2")};
  };
  OdeState a = published(0), b = a;
  std::ofstream out(folders.out + "/published_attitude.csv");
  out << "t,theta_B_published,theta_B_their_row,theta_B_correct_row\n" << std::setprecision(12);
  double low = INFINITY, high = -INFINITY, error = 0.0, difference = 0.0, step = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (n > 0) {
      const auto ignore = [](const OdeState&, double) {};
      integrate(theirs, a, rows(n - 1, "t"), rows(n, "t"), 2, ignore);
      integrate(ours, b, rows(n - 1, "t"), rows(n, "t"), 2, ignore);
      OdeState c = published(n - 1);
      integrate(theirs, c, rows(n - 1, "t"), rows(n, "t"), 2, ignore);
      step = std::max(step, std::abs(c[2] - rows(n, "thetaB")));
    }
    const double theta = rows(n, "thetaB");
    out << rows(n, "t") << ',' << theta << ',' << a[2] << ',' << b[2] << '\n';
    low = std::min(low, theta), high = std::max(high, theta);
    error = std::max(error, std::abs(a[2] - theta));
    difference = std::max(difference, std::abs(b[2] - theta));
  }
  // The loads are splined and do not answer to the motion, so small errors grow: the proof of the
  // row is the balance above.
  return {{"published", "body pitch from row to row with their row, difference / swing (hover)",
           "each of 1000 intervals, loads splined", step, high - low, step / (high - low), kStated},
          {"published", "body pitch over three flaps with their row, difference / swing (hover)",
           "loads splined through 1001 rows", error, high - low, error / (high - low), 1e-2},
          {"published", "body pitch with the correct row leaves theirs by, rad (hover)",
           "the same loads", difference, 0.0, difference, kStated}};
}

}  // namespace

DynamicsRows checkPublished(const DynamicsFolders& folders) {
  DynamicsRows rows = alongHistory(kHover, folders.data);
  for (const DynamicsRows& more : {alongHistory(kPassive, folders.data), attitude(folders)}) {
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace monarch_flight::verify
