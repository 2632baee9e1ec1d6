#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "monarch_flight/insect/fourier_motion.h"
#include "monarch_flight/insect/start_motion.h"
#include "monarch_flight/insect/table_motion.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

constexpr double kLength = 0.01;  // of what the tables move [m]

template <typename Value>
Value difference(const std::function<Value(double)>& f, double t, double h) {
  return (45.0 * (f(t + h) - f(t - h)) - 9.0 * (f(t + 2 * h) - f(t - 2 * h)) +
          (f(t + 3 * h) - f(t - 3 * h))) /
         (60.0 * h);
}

TEST(Fourier, DerivativesAgreeWithDifferences) {
  const FourierSeries series{-0.3, {0.5, -0.2, 0.03}, {0.1, 0.4, -0.07}, 2};
  const double f = 1.3;
  for (double t = -0.4; t < 1.0; t += 0.137) {
    const auto q = [&](double s) { return series.at(f, s).q; };
    const auto qd = [&](double s) { return series.at(f, s).qd; };
    EXPECT_NEAR(series.at(f, t).qd, difference<double>(q, t, 1e-4), 1e-9);
    EXPECT_NEAR(series.at(f, t).qdd, difference<double>(qd, t, 1e-4), 1e-7);
  }
}

TEST(Fourier, ValuesAtNamedTimes) {
  const FourierSeries series{1.0, {2.0, 0.0}, {0.0, 3.0}, 1};
  const double f = 0.5, w = M_PI;
  EXPECT_NEAR(series.at(f, 0.0).q, 3.0, 1e-15);
  EXPECT_NEAR(series.at(f, 0.0).qd, 6.0 * w, 1e-13);
  EXPECT_NEAR(series.at(f, 0.0).qdd, -2.0 * w * w, 1e-13);
  EXPECT_NEAR(series.at(f, 0.25).q, 1.0 + 2.0 * std::cos(M_PI / 4.0) + 3.0, 1e-14);
  EXPECT_NEAR(series.at(f, 2.0).q, series.at(f, 0.0).q, 1e-14);  // one period
  const FourierSeries twice{0.0, {1.0}, {0.0}, 2};
  EXPECT_NEAR(twice.at(f, 1.0).q, 1.0,
              1e-14);  // half a period of the flap, a whole one of the series
}

TEST(Fourier, MotionMovesBodyAndPitches) {
  FourierMotionSettings s;
  s.frequency = 10.0;
  s.phi = {0.1, {1.0}, {0.0}, 1};
  s.pitch = {0.3, {0.0}, {0.2}, 1};
  s.position << 1, 2, 3;
  s.velocity << 1.3, 0, -0.5;
  const PrescribedState state = FourierMotion(s).at(0.025);
  EXPECT_LT((state.body.x - Eigen::Vector3d(1.0325, 2.0, 2.9875)).norm(), 1e-15);
  EXPECT_EQ(state.body.v, s.velocity);
  EXPECT_EQ(state.body.a, Eigen::Vector3d::Zero());
  EXPECT_NEAR(state.body.pitch.q, 0.5, 1e-15);
  EXPECT_LT((state.body.R_IB() - rotationY(0.5)).norm(), 1e-15);
  EXPECT_NEAR(state.body.Omega_dot_B.y(), -0.2 * std::pow(20.0 * M_PI, 2), 1e-9);
  EXPECT_NEAR(state.angles.wings.right.phi.q, 0.1, 1e-15);
}

TEST(Start, ExplicitCoordinatesLeaveAtAConstantRate) {
  FourierMotionSettings s;
  s.frequency = 10.0;
  s.pitch = {0.3, {0.1}, {0.2}, 1};
  s.theta = {0.0, {0.5}, {0.0}, 1};
  s.velocity << 1, 0.5, 0;
  StartValues start;
  start.x = StartValue{2.0, 3.0};
  start.theta_R = StartValue{0.1, -4.0};
  const auto base = std::make_shared<FourierMotion>(s);
  const StartMotion motion(base, start, 0.5);
  const PrescribedState at = motion.at(0.6);
  EXPECT_NEAR(at.body.x.x(), 2.3, 1e-15);
  EXPECT_EQ(at.body.v.x(), 3.0);
  EXPECT_EQ(at.body.x.y(), base->at(0.6).body.x.y());
  EXPECT_NEAR(at.angles.wings.right.theta.q, -0.3, 1e-15);
  EXPECT_EQ(at.angles.wings.right.theta.qdd, 0.0);
  EXPECT_EQ(at.body.pitch.q, base->at(0.6).body.pitch.q);
  start.pitch = StartValue{0.2, 1.0};
  const PrescribedState pitched = StartMotion(base, start, 0.5).at(0.6);
  EXPECT_LT((pitched.body.R_IB() - rotationY(0.3)).norm(), 1e-15);
  EXPECT_EQ(pitched.body.Omega_B.y(), 1.0);
  EXPECT_EQ(pitched.body.Omega_dot_B.y(), 0.0);
}

/// A tumbling wing whose attitude, angular velocity and acceleration are known.
struct Tumble {
  static Eigen::Matrix3d R(double t) {
    return rotationZ(0.8 * std::sin(2 * t)) * rotationX(3.0 * t) * rotationY(0.5 * std::cos(t));
  }
  static Eigen::Vector3d omega(double t) {
    const Eigen::Matrix3d Rx = rotationX(3.0 * t), Ry = rotationY(0.5 * std::cos(t));
    return Eigen::Vector3d(0, -0.5 * std::sin(t), 0) + Ry.transpose() * Eigen::Vector3d(3, 0, 0) +
           Ry.transpose() * Rx.transpose() * Eigen::Vector3d(0, 0, 1.6 * std::cos(2 * t));
  }
  static Eigen::Vector3d x(double t) { return {std::sin(t), t * t, std::exp(-t)}; }
};

NumericTable wingTable(int n, double length) {
  NumericTable table{"tumble", TableMotion::columnsOf(TableKind::kWing), {}};
  for (int i = 0; i < n; ++i) {
    const double t = length * i / (n - 1);
    const Eigen::Quaterniond q(Tumble::R(t));
    const Eigen::Vector3d x = Tumble::x(t);
    const double sign = i % 3 == 0 ? -1.0 : 1.0;  // both signs are the same attitude
    table.rows.push_back(
        {t, x.x(), x.y(), x.z(), sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()});
  }
  return table;
}

/// Largest errors of position, velocity, acceleration, attitude, angular velocity and acceleration.
std::array<double, 6> tumbleErrors(int n) {
  const TableMotion motion(wingTable(n, 2.0), TableKind::kWing, kLength);
  std::array<double, 6> worst{};
  for (int i = 0; i <= 997; ++i) {
    const double t = 2.0 * i / 997;
    const BodyState b = motion.at(t).body;
    const Eigen::Vector3d v(std::cos(t), 2 * t, -std::exp(-t));
    const Eigen::Vector3d a(-std::sin(t), 2, std::exp(-t));
    const Eigen::Vector3d alpha = difference<Eigen::Vector3d>(&Tumble::omega, t, 1e-3);
    const std::array<double, 6> errors{(b.x - Tumble::x(t)).norm(),
                                       (b.v - v).norm(),
                                       (b.a - a).norm(),
                                       (b.R_IB() - Tumble::R(t)).norm(),
                                       (b.Omega_B - Tumble::omega(t)).norm(),
                                       (b.Omega_dot_B - alpha).norm()};
    for (int k = 0; k < 6; ++k) worst[k] = std::max(worst[k], errors[k]);
  }
  return worst;
}

TEST(Table, ErrorsFallWithTheirOrder) {
  const std::array<double, 6> coarse = tumbleErrors(81);
  const std::array<double, 6> fine = tumbleErrors(161);
  const std::array<double, 6> order{6, 5, 4, 6, 5, 4};
  for (int k = 0; k < 6; ++k) {
    const double measured = std::log2(coarse[k] / fine[k]);
    EXPECT_GT(measured, order[k] - 0.5) << "quantity " << k << ": " << coarse[k] << " " << fine[k];
  }
  EXPECT_LT(fine[3], 1e-6);
  EXPECT_LT(fine[5], 1e-1);
}

TEST(Table, DerivativesAreThoseOfTheInterpolatedMotion) {
  const TableMotion motion(wingTable(21, 2.0), TableKind::kWing, kLength);
  const auto body = [&](double t) { return motion.at(t).body; };
  const double h = 1e-4;
  for (double t = 0.013; t < 1.9; t += 0.0917) {
    const BodyState b = body(t);
    const Eigen::Vector3d v =
        difference<Eigen::Vector3d>([&](double s) -> Eigen::Vector3d { return body(s).x; }, t, h);
    const Eigen::Vector3d a =
        difference<Eigen::Vector3d>([&](double s) -> Eigen::Vector3d { return body(s).v; }, t, h);
    const Eigen::Matrix3d Rd = difference<Eigen::Matrix3d>(
        [&](double s) -> Eigen::Matrix3d { return body(s).R_IB(); }, t, h);
    const Eigen::Vector3d Od = difference<Eigen::Vector3d>(
        [&](double s) -> Eigen::Vector3d { return body(s).Omega_B; }, t, h);
    EXPECT_LT((b.v - v).norm(), 1e-9);
    EXPECT_LT((b.a - a).norm(), 1e-8);
    EXPECT_LT((b.R_IB().transpose() * Rd - hat(b.Omega_B)).norm(), 1e-8);
    EXPECT_LT((b.Omega_dot_B - Od).norm(), 1e-7);
    EXPECT_NEAR(b.pitch.q, std::asin(-b.R_IB()(2, 0)), 1e-14);
    const double qd = difference<double>([&](double s) { return body(s).pitch.q; }, t, h);
    const double qdd = difference<double>([&](double s) { return body(s).pitch.qd; }, t, h);
    EXPECT_NEAR(b.pitch.qd, qd, 1e-7);
    EXPECT_NEAR(b.pitch.qdd, qdd, 1e-6);
  }
}

NumericTable bodyTable(int n) {
  NumericTable table{"body.csv", TableMotion::columnsOf(TableKind::kBody), {}};
  for (int i = 0; i < n; ++i) {
    const double t = 0.01 * i;
    table.rows.push_back({t, 1.3 * t, 0.0, -0.5 * t, 0.3 + t, 2 * t, 3 * t, 4 * t, t * t});
  }
  return table;
}

TEST(Table, BodyKindReproducesPolynomialsExactly) {
  const TableMotion motion(bodyTable(30), TableKind::kBody, kLength);
  const PrescribedState s = motion.at(0.1234);
  EXPECT_NEAR(s.body.x.x(), 1.3 * 0.1234, 1e-13);
  EXPECT_NEAR(s.body.v.z(), -0.5, 1e-12);
  EXPECT_NEAR(s.body.pitch.q, 0.4234, 1e-13);
  EXPECT_NEAR(s.body.Omega_B.y(), 1.0, 1e-11);
  EXPECT_NEAR(s.angles.wings.right.phi.qd, 2.0, 1e-11);
  EXPECT_NEAR(s.angles.wings.right.psi.q, 0.3702, 1e-13);
  EXPECT_NEAR(s.angles.wings.right.theta.q, 0.4936, 1e-13);
  EXPECT_NEAR(s.angles.theta_A.qdd, 2.0, 1e-8);
  EXPECT_NO_THROW(motion.at(0.29));
  EXPECT_THROW(motion.at(0.2901), std::out_of_range);
  EXPECT_THROW(motion.at(-0.0001), std::out_of_range);
  EXPECT_THROW(motion.at(NAN), std::out_of_range);
}

std::string faultOf(const NumericTable& table, TableKind kind) {
  try {
    TableMotion motion(table, kind, kLength);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no fault";
}

TEST(Table, EveryFaultNamesFileRowAndColumn) {
  NumericTable table = bodyTable(30);
  table.rows[7][0] = 0.055;
  EXPECT_NE(
      faultOf(table, TableKind::kBody).find("body.csv: row 8, column t = 0.055 s: must be > "),
      std::string::npos)
      << faultOf(table, TableKind::kBody);
  table = bodyTable(30);
  table.rows.erase(table.rows.begin() + 9);
  EXPECT_NE(
      faultOf(table, TableKind::kBody).find("body.csv: row 10, column t = 0.1 s: gap of 0.02 s"),
      std::string::npos)
      << faultOf(table, TableKind::kBody);
  table = bodyTable(30);
  table.rows[4][5] = NAN;
  EXPECT_NE(faultOf(table, TableKind::kBody).find("body.csv: row 5, column phi is not a finite"),
            std::string::npos);
  EXPECT_NE(faultOf(bodyTable(5), TableKind::kBody).find("5 rows: must be >= 6"),
            std::string::npos);
  table = bodyTable(30);
  table.columns[5] = "fi";
  EXPECT_NE(faultOf(table, TableKind::kBody).find("column 'phi' is missing"), std::string::npos);
  table = wingTable(41, 2.0);
  table.rows[12][5] += 0.1;
  EXPECT_NE(faultOf(table, TableKind::kWing).find("tumble: row 13, column qw..qz: length"),
            std::string::npos);
  EXPECT_NE(faultOf(wingTable(9, 8.0), TableKind::kWing).find("must be <= 90"), std::string::npos);
}

TEST(Csv, ReadsNumbersAndSkipsComments) {
  std::istringstream in("# a comment\n\n t , x\r\n0, 1e-3\n 0.1 ,2\n");
  const NumericTable table = readCsv(in, "a.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"t", "x"}));
  EXPECT_EQ(table.column("x"), (std::vector<double>{1e-3, 2.0}));
  EXPECT_EQ(table.select({"x", "t"}).rows[1], (std::vector<double>{2.0, 0.1}));
}

TEST(Csv, EveryBadCellIsNamed) {
  std::istringstream in("t,x\n0,1\n0.1,abc\n0.2\n0.3,nan\n0.4,\n");
  try {
    readCsv(in, "a.csv");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("a.csv: row 2 (line 3), column x = 'abc'"), std::string::npos) << text;
    EXPECT_NE(text.find("a.csv: row 3 (line 4) has 1 values: must be 2"), std::string::npos)
        << text;
    EXPECT_NE(text.find("row 4 (line 5), column x = 'nan'"), std::string::npos) << text;
    EXPECT_NE(text.find("row 5 (line 6), column x = ''"), std::string::npos) << text;
  }
  std::istringstream empty("t,x\n");
  EXPECT_THROW(readCsv(empty, "empty.csv"), InputError);
  std::istringstream marked("\xEF\xBB\xBFt,y\n1,2\n");
  EXPECT_EQ(readCsv(marked, "marked.csv").columns[0], "t");
  std::istringstream twins("t,y,t\n1,2,3\n");
  try {
    readCsv(twins, "twins.csv");
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("column 't' is given twice"), std::string::npos);
  }
  EXPECT_THROW(readCsv("/nonexistent.csv"), InputError);
}

/// Roll, pitch and yaw that all move: rates and accelerations are those of the attitude.
TEST(Start, AnglesOfABodyThatLeavesItsPlaneHaveTheRatesThatItSays) {
  const auto at = [](double t) {
    const StartValue roll{0.3, 2.0, -5.0}, pitch{0.7, -1.5, 4.0}, yaw{-1.1, 3.0, 6.0};
    return withAngles(BodyState(), roll.at(t), pitch.at(t), yaw.at(t));
  };
  const BodyState body = at(0.1);
  const std::function<Eigen::Matrix3d(double)> attitude = [&at](double t) { return at(t).R_IB(); };
  const std::function<Eigen::Vector3d(double)> rate = [&at](double t) { return at(t).Omega_B; };
  const Eigen::Matrix3d R_dot = difference(attitude, 0.1, 1e-3);
  EXPECT_LT((vee(body.R_IB().transpose() * R_dot) - body.Omega_B).norm(), 1e-9);
  EXPECT_LT((difference(rate, 0.1, 1e-3) - body.Omega_dot_B).norm(), 1e-8);
  EXPECT_LT((rollPitchYaw(body.R_IB()) - Eigen::Vector3d(0.475, 0.57, -0.77)).norm(), 1e-12);
}

}  // namespace
}  // namespace monarch_flight
