// Body attitude of the published hover with their moment row in place of ours, and with ours.
#include <fstream>
#include <iomanip>

#include "dynamics/ode.h"
#include "dynamics/published.h"
#include "insect/smooth_spline.h"

namespace monarch_flight::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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
    const WingAngles wing{angle(1), angle(3), angle(2)};
    const JointAngles angles{{wing, wing}, angle(0)};
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
    s.angles = angles;
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

}  // namespace

DynamicsRows checkAttitude(const DynamicsFolders& folders) {
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

}  // namespace monarch_flight::verify
