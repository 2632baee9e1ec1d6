// What a table of a motion must hold from row to row.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "insect/smooth_spline.h"
#include "monarch_flight/insect/table_motion.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/math/rotation.h"

namespace monarch_flight {
namespace {

constexpr double kChord = 0.03;  // m
enum Column { kT, kX, kY, kZ, kThetaB, kPhi, kPsi, kThetaR, kThetaA };
using Function = std::function<double(double)>;

/// A body at rest but for one column, `n` rows that lie `spacing` apart [s]; f of the row's number.
NumericTable bodyTable(int n, double spacing, Column column, const Function& f) {
  NumericTable table{"m.csv", TableMotion::columnsOf(TableKind::kBody), {}};
  for (int i = 0; i < n; ++i) {
    std::vector<double> row{spacing * i, 1.0, 0.0, -2.0, 0.3, 0.0, 0.1, -0.2, 0.4};
    row[column] += f(i);
    table.rows.push_back(row);
  }
  return table;
}

std::string faultOf(const NumericTable& table, TableKind kind = TableKind::kBody) {
  try {
    TableMotion motion(table, kind, kChord);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

void expectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n" << text;
}

const std::pair<Column, const char*> kAngles[] = {
    {kThetaB, "theta_B"}, {kPhi, "phi"}, {kPsi, "psi"}, {kThetaR, "theta_R"}, {kThetaA, "theta_A"}};

double wrapped(double angle) { return std::atan2(std::sin(angle), std::cos(angle)); }

TEST(TableAngles, AreTheSameHoweverTheyAreWrapped) {
  for (const auto& [column, name] : kAngles) {
    for (const double rate : {0.02, -0.3}) {  // a row: turns over once, many times
      const NumericTable smooth =
          bodyTable(200, 0.01, column, [&](double i) { return 2.9 + rate * i; });
      NumericTable cut = smooth;
      for (auto& row : cut.rows) row[column] = wrapped(row[column]);
      const TableMotion a(smooth, TableKind::kBody, kChord), b(cut, TableKind::kBody, kChord);
      for (double t = 0.001; t < 1.99; t += 0.0137) {
        const PrescribedState s = a.at(t), w = b.at(t);
        const WingAngles &own = s.angles.wings.right, &other_own = w.angles.wings.right;
        const std::pair<Coordinate, Coordinate> all[] = {{s.body.pitch, w.body.pitch},
                                                         {own.phi, other_own.phi},
                                                         {own.psi, other_own.psi},
                                                         {own.theta, other_own.theta},
                                                         {s.angles.theta_A, w.angles.theta_A}};
        for (const auto& [one, other] : all) {
          EXPECT_NEAR(wrapped(one.q - other.q), 0.0, 1e-11) << name;
          EXPECT_NEAR(one.qd, other.qd, 1e-9) << name;
          EXPECT_NEAR(one.qdd, other.qdd, 1e-6) << name;
        }
      }
    }
  }
}

TEST(TableChanges, AJumpIsRefusedInEveryColumn) {
  const auto jump = [](double by) { return [by](double i) { return i < 20 ? 0.0 : by; }; };
  for (const auto& [column, name] : kAngles) {
    for (const double by : {1.0, -1.0, 0.02}) {
      const std::string text = faultOf(bodyTable(40, 0.002, column, jump(by)));
      expectHas(text, std::string("m.csv: row 21, column ") + name);
      expectHas(text, by > 0 ? "must be <= 0.01 rad" : "must be >= -0.01 rad");
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;  // one fault, one line
    }
    EXPECT_EQ(faultOf(bodyTable(40, 0.002, column, jump(0.009))), "");  // rounding
  }
  for (const Column column : {kX, kY, kZ}) {
    const std::string text = faultOf(bodyTable(40, 0.002, column, jump(0.01)));
    expectHas(text, std::string("row 21, column ") + "txyz"[column]);
    expectHas(text, "changes by 0.01 m since the row before: must be <= 0.0003 m");
    EXPECT_EQ(faultOf(bodyTable(40, 0.002, column, jump(0.009 * kChord))), "");
  }
}

TEST(TableChanges, AJumpWithinAMotionAndARowOutOfLineAreRefused) {
  for (int at = 10; at < 90; ++at) {
    const auto flap = [](double i) { return std::sin(2 * M_PI * i / 50); };
    EXPECT_NE(faultOf(bodyTable(101, 0.002, kPhi,
                                [&](double i) { return flap(i) + (i < at ? 0.0 : 0.1); })),
              "")
        << at;
    EXPECT_NE(faultOf(bodyTable(101, 0.002, kPhi,
                                [&](double i) { return flap(i) + (i == at ? 0.1 : 0.0); })),
              "")
        << at;
  }
  for (const int at : {0, 1, 2, 37, 38, 39}) {  // rows with neighbours on one side
    EXPECT_NE(faultOf(bodyTable(40, 0.002, kPhi, [&](double i) { return i == at ? 0.3 : 0.0; })),
              "")
        << at;
  }
}

TEST(TableChanges, AMotionThatTheRowsResolvePassesInAnyScale) {
  for (const double spacing : {1e-5, 0.002, 7.0}) {
    for (const double amplitude : {1e-6, 1.0, 500.0}) {  // m
      for (int phase = 0; phase < 20; ++phase) {
        const auto sine = [&](double rows) {
          return [=](double i) {
            return amplitude * std::sin(2 * M_PI * i / rows + 2 * M_PI * phase / 20);
          };
        };
        for (const double rows : {6.0, 6.5, 8.0, 50.0}) {
          EXPECT_EQ(faultOf(bodyTable(60, spacing, kX, sine(rows))), "") << rows;
        }
      }
    }
  }
  // From rest at once, at a steady rate, and to and fro like a saw: speeds jump, places do not.
  for (const double rate : {0.05, 0.5}) {
    EXPECT_EQ(
        faultOf(bodyTable(40, 0.01, kPhi, [&](double i) { return std::max(0.0, i - 20) * rate; })),
        "");
    EXPECT_EQ(
        faultOf(bodyTable(60, 0.01, kPhi,
                          [&](double i) { return rate * std::abs(std::remainder(i, 14.0)); })),
        "");
  }
}

TEST(TableChanges, TooFewRowsForAMotionAreRefused) {
  for (const double rows : {4.3, 4.5}) {
    expectHas(faultOf(bodyTable(60, 0.01, kPhi,
                                [&](double i) { return 1.2 * std::sin(2 * M_PI * i / rows); })),
              "give more rows of so fast a motion");
  }
}

/// Largest errors of the spline through a sine, and of its second derivative, far from the ends.
std::pair<double, double> sineErrors(double rows) {
  const double w = 2 * M_PI / rows;
  std::vector<double> t;
  Eigen::MatrixXd samples(1, 120);
  for (int i = 0; i < 120; ++i) {
    t.push_back(i);
    samples(0, i) = std::sin(w * i + 0.3);
  }
  const SmoothSpline spline(t, samples);
  std::pair<double, double> worst{0.0, 0.0};
  for (double s = 50; s < 70; s += 0.013) {
    const SmoothSpline::Value v = spline.at(s);
    worst.first = std::max(worst.first, std::abs(v.q[0] - std::sin(w * s + 0.3)));
    worst.second = std::max(worst.second, std::abs(v.qdd[0] / (w * w) + std::sin(w * s + 0.3)));
  }
  return worst;
}

TEST(TableChanges, SixRowsInAPeriodAreEnoughForTheSpline) {  // docs/case_files.md
  EXPECT_LT(sineErrors(6).first, 2e-4);
  EXPECT_LT(sineErrors(6).second, 2.5e-3);
  EXPECT_GT(sineErrors(4).first, 2e-3);
  EXPECT_GT(sineErrors(4).second, 1e-2);
}

/// A wing that turns about the axis `axis` of its own, by f of the row's number [rad].
NumericTable wingTable(int n, int axis, const Function& f) {
  NumericTable table{"w.csv", TableMotion::columnsOf(TableKind::kWing), {}};
  const Eigen::Matrix3d base = rotationZ(0.7) * rotationX(0.4);
  for (int i = 0; i < n; ++i) {
    const Eigen::Quaterniond q(base * expSO3(f(i) * Eigen::Vector3d::Unit(axis)));
    table.rows.push_back({0.01 * i, 0, 0, 0, q.w(), q.x(), q.y(), q.z()});
  }
  return table;
}

TEST(TableChanges, AnAttitudeThatJumpsIsRefused) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string text =
        faultOf(wingTable(40, axis, [](double i) { return i < 20 ? 0.0 : 1.0; }), TableKind::kWing);
    expectHas(text, "w.csv: row 21, column qw..qz: turns by 1 rad about the wing's ");
    expectHas(text,
              std::string(1, "xyz"[axis]) + " axis since the row before: must be <= 0.01 rad");
    EXPECT_EQ(
        faultOf(wingTable(60, axis, [](double i) { return 0.9 * std::sin(i); }), TableKind::kWing),
        "");
    EXPECT_EQ(faultOf(wingTable(60, axis, [](double i) { return 1.5 * i; }), TableKind::kWing), "");
  }
}

std::string csvFault(const std::string& text) {
  std::istringstream in(text);
  try {
    readCsv(in, "a.csv");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Csv, SaysThatTheSeparatorMustBeAComma) {
  for (const auto& [text, word] :
       {std::pair{"t;x\n0;1\n", "semicolons"}, std::pair{"t;x\n0,5;1,5\n", "semicolons"},
        std::pair{"# units\nt\tx\n0\t1\n", "tabs"}, std::pair{"t x\n0 1\n", "blanks"},
        std::pair{"t|x\n0|1\n", "bars"}}) {
    const std::string fault = csvFault(text);
    expectHas(fault, "a.csv: header = 't");
    expectHas(fault, std::string("must be separated by commas, not ") + word);
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;  // once, not for every cell
  }
  expectHas(csvFault("t,x\n0,1\n0,5;1,5\n"), "row 2 (line 3) = '0': columns must be separated");
  expectHas(csvFault("t,x\n0\t1\n"), "row 1 (line 2) = '0\t1': columns must be separated");
  expectHas(csvFault("t,x\n0,5,1,5\n"),
            "has 4 values: must be 2 as in the header; commas separate columns, so numbers need a "
            "decimal point");
  EXPECT_EQ(csvFault("t,\tthe place\n0,\t1\n"), "");
}

}  // namespace
}  // namespace monarch_flight
