#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "monarch_flight/insect/build.h"
#include "monarch_flight/insect/numeric_table.h"

namespace monarch_flight {
namespace {

Planform monarchPlanform() {
  const NumericTable table = readCsv(std::string(CONFIG_DIR) + "/insects/monarch_planform.csv");
  std::vector<double> y = table.column("y");
  std::vector<double> leading = table.column("leading");
  std::vector<double> trailing = table.column("trailing");
  for (auto* values : {&y, &leading, &trailing}) {
    for (double& value : *values) value *= 0.01;
  }
  return Planform::polynomial(y, leading, trailing, 6);
}

nlohmann::json published() {
  std::ifstream in(std::string(TEST_DATA_DIR) + "/monarch_morphology_fwuav.json");
  return nlohmann::json::parse(in);
}

void expectRelative(double value, double exact, double tolerance, const char* what) {
  EXPECT_NEAR(value, exact, tolerance * std::abs(exact)) << what;
}

TEST(Planform, MomentsOfARectangleAreExact) {
  const double c = 0.3, b = 0.8, hinge = 0.25, y0 = 0.1;
  const Planform p = Planform::rectangle(c, b, hinge, y0);
  const double x1 = hinge * c, x0 = x1 - c, y1 = y0 + b;
  for (int px = 0; px <= 4; ++px) {
    for (int py = 0; py <= 4; ++py) {
      const double exact = (std::pow(x1, px + 1) - std::pow(x0, px + 1)) / (px + 1) *
                           (std::pow(y1, py + 1) - std::pow(y0, py + 1)) / (py + 1);
      EXPECT_NEAR(p.moment(px, py), exact, 1e-15) << px << ' ' << py;
    }
  }
  expectRelative(p.area(), c * b, 1e-14, "area");
  expectRelative(p.meanChord(), c, 1e-14, "mean chord");
  EXPECT_DOUBLE_EQ(p.xMax(), x1);
  EXPECT_DOUBLE_EQ(p.xMin(), x0);
}

TEST(Planform, MomentsOfAnEllipseAreExact) {
  const double c = 0.4, b = 1.0, hinge = 0.5, y0 = 0.2;
  const Planform p = Planform::ellipse(c, b, hinge, y0);
  const double area = M_PI / 4.0 * c * b;
  const double yc = y0 + 0.5 * b;
  expectRelative(p.area(), area, 1e-12, "area");
  EXPECT_NEAR(p.moment(1, 0), 0.0, 1e-15);
  expectRelative(p.moment(0, 1), area * yc, 1e-12, "first moment in y");
  expectRelative(p.moment(2, 0), area * c * c / 16.0, 1e-12, "second moment in x");
  expectRelative(p.moment(0, 2), area * (b * b / 16.0 + yc * yc), 1e-12, "second moment in y");
  expectRelative(p.moment(4, 0), M_PI / 8.0 * std::pow(c / 2.0, 5) * (b / 2.0), 1e-12,
                 "fourth in x");
  EXPECT_NEAR(p.xMax(), c / 2.0, 1e-12);
  EXPECT_NEAR(p.xMin(), -c / 2.0, 1e-12);
}

TEST(Planform, TriangleFromATableIsExact) {
  const Planform p = Planform::table({0.0, 1.0, 2.0}, {0.0, 0.0, 0.0}, {0.0, -1.0, 0.0});
  expectRelative(p.area(), 1.0, 1e-13, "area");
  expectRelative(p.moment(0, 1), 1.0, 1e-13, "first moment in y");
  expectRelative(p.moment(1, 0), -1.0 / 3.0, 1e-13, "first moment in x");
  expectRelative(p.moment(0, 2), 7.0 / 6.0, 1e-13, "second moment in y");
  EXPECT_NEAR(p.xMin(), -1.0, 1e-9);
  EXPECT_DOUBLE_EQ(p.chord(1.5), 0.5);
}

TEST(Planform, PolynomialOrderSixReproducesASexticAndClampsCrossedEdges) {
  std::vector<double> y, leading, trailing;
  const auto edge = [](double s) { return 0.2 + s * s - 0.3 * std::pow(s, 6); };
  for (int i = 0; i <= 12; ++i) {
    y.push_back(i / 12.0);
    leading.push_back(edge(y.back()));
    trailing.push_back(0.0);
  }
  const Planform p = Planform::polynomial(y, leading, trailing);
  expectRelative(p.area(), 0.2 + 1.0 / 3.0 - 0.3 / 7.0, 1e-12, "area");
  EXPECT_NEAR(p.leading(0.37), edge(0.37), 1e-12);

  // Edges that cross a little before the tip: no chord beyond.
  const Planform crossed =
      Planform::polynomial({0.0, 0.5, 1.0}, {0.5, 0.245, -0.01}, {0.0, 0.0, 0.0}, 1);
  expectRelative(crossed.area(), 0.25 * 0.5 / 0.51, 1e-10, "area before the crossing");
  EXPECT_DOUBLE_EQ(crossed.chord(0.99), 0.0);
}

TEST(Planform, ScalingTakesSpanAndAreaAndScalesMoments) {
  const Planform raw = monarchPlanform();
  const Planform p = raw.scaledTo(0.052, 1.52e-3);
  expectRelative(p.span(), 0.052, 1e-14, "span");
  expectRelative(p.area(), 1.52e-3, 1e-12, "area");
  const double fy = 0.052 / raw.span();
  const double fx = 1.52e-3 / raw.area() / fy;
  expectRelative(p.moment(2, 1), raw.moment(2, 1) * std::pow(fx, 3) * std::pow(fy, 2), 1e-11,
                 "moment");
}

TEST(Planform, SweepMovesEveryChordBack) {
  const Planform p = monarchPlanform();
  const double slope = 0.2;
  const Planform swept = p.sweptBack(std::atan(slope));
  EXPECT_NEAR(swept.leading(0.03), p.leading(0.03) - slope * 0.03, 1e-15);
  EXPECT_NEAR(swept.chord(0.03), p.chord(0.03), 1e-15);
  EXPECT_DOUBLE_EQ(swept.span(), p.span());
  expectRelative(swept.area(), p.area(), 1e-12, "area");
  expectRelative(swept.moment(1, 0), p.moment(1, 0) - slope * p.moment(0, 1), 1e-11, "first");
  expectRelative(swept.moment(2, 0),
                 p.moment(2, 0) - 2.0 * slope * p.moment(1, 1) + slope * slope * p.moment(0, 2),
                 1e-11, "second");
  const Planform rectangle = Planform::rectangle(1.0, 2.0, 0.25, 0.5).sweptBack(std::atan(slope));
  EXPECT_NEAR(rectangle.xMax(), 0.25 - slope * 0.5, 1e-12);   // the root's leading edge
  EXPECT_NEAR(rectangle.xMin(), -0.75 - slope * 2.5, 1e-12);  // the tip's trailing edge
  EXPECT_THROW(p.sweptBack(1.1), std::invalid_argument);
  EXPECT_THROW(p.sweptBack(std::nan("")), std::invalid_argument);
}

TEST(Planform, FaultsAreNamed) {
  const auto message = [](const std::function<void()>& build) -> std::string {
    try {
      build();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message([] { Planform::rectangle(1.0, 0.0, 0.5); }).find("span = 0 m"),
            std::string::npos);
  EXPECT_NE(message([] { Planform::ellipse(-1.0, 1.0, 0.5); }).find("chord = -1 m"),
            std::string::npos);
  EXPECT_NE(message([] {
              Planform::table({0, 1}, {0, 0}, {-1, 1});
            }).find("must be >= 0"),
            std::string::npos);
  EXPECT_NE(message([] {
              Planform::table({0, 1}, {0, 0}, {0, 0});
            }).find("area"),
            std::string::npos);
  EXPECT_NE(message([] {
              Planform::table({0, 1, 1}, {1, 1, 1}, {0, 0, 0});
            }).find("station 3"),
            std::string::npos);
  EXPECT_NE(message([] {
              Planform::table({0, 1, 2, 3}, {1, 0, 0, 1}, {0, 0, 0, 0});
            }).find("no chord from y = 1 m to y = 2 m"),
            std::string::npos);
  EXPECT_EQ(message([] { Planform::table({0, 1, 2}, {1, 0, 1}, {0, 0, 0}); }), "");  // pinched
  EXPECT_EQ(message([] { Planform::table({0, 1, 2, 3}, {0, 0, 1, 0}, {0, 0, 0, 0}); }), "");
  const std::vector<double> y{0, 0.5, 1}, x{1, 1, 1}, zero{0, 0, 0};
  EXPECT_NE(message([&] {
              Planform::polynomial(y, {0.5, 0, -0.5}, {-0.5, 0, 0.5}, 1);
            }).find("edges cross, by 1 m at y = 1 m"),
            std::string::npos);
  EXPECT_NE(message([&] {
              Planform::polynomial(y, x, {0, 0.6, 0}, 1);
            }).find("miss the stations"),
            std::string::npos);
  // Edges that cross a little between root and tip would part the wing in two.
  EXPECT_NE(
      message([] {
        Planform::polynomial({0, 1, 2, 3, 4}, {0.395, 0.095, -0.005, 0.095, 0.395}, {0, 0, 0, 0, 0},
                             2);
      })
          .find("the wing must be one piece from root to tip; give these stations a chord (edges "
                "that are polynomials: change the order"),
      std::string::npos);
  EXPECT_EQ(
      message([] {
        Planform::polynomial({0, 1, 2, 3, 4}, {0.41, 0.11, 0.01, 0.11, 0.41}, {0, 0, 0, 0, 0}, 2);
      }),
      "");
  EXPECT_NE(message([&] { Planform::polynomial(y, x, zero, 3); }).find("from 1 to 2"),
            std::string::npos);
  EXPECT_NE(message([] {
              Planform::table({0, NAN}, {1, 1}, {0, 0});
            }).find("station 2"),
            std::string::npos);
}

TEST(Monarch, PlanformAndWingAgreeWithThePublishedNumbers) {
  const nlohmann::json data = published();
  const Planform p = monarchPlanform();
  expectRelative(p.area(), data["S"], 1e-11, "area");
  expectRelative(p.span(), data["l"], 1e-12, "span");
  expectRelative(p.meanChord(), data["c_bar"], 1e-11, "mean chord");
  const Appendage wing = plateWing(p, data["m_R"], Eigen::Vector3d(0.0, 0.00284, 0.0));
  expectRelative(wing.nu.x(), data["nu_R"][0], 1e-9, "nu x");
  // The published spanwise distance is half of the plate's (test/data/README.md).
  expectRelative(wing.nu.y(), 2.0 * data["nu_R"][1].get<double>(), 1e-9, "nu y");
  expectRelative(wing.nu.y(), data["tilde_r_1"].get<double>() * p.span(), 1e-9, "nu y");
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      expectRelative(wing.J(i, k), data["J_R"][i][k], 1e-8, "J_R");
      expectRelative(mirrored(wing).J(i, k), data["J_L"][i][k], 1e-8, "J_L");
    }
    EXPECT_DOUBLE_EQ(mirrored(wing).mu[i], data["mu_L"][i].get<double>());
  }
}

TEST(Monarch, CylindersAgreeWithThePublishedNumbers) {
  const nlohmann::json d = published();
  const Cylinder body{d["m_B"], d["h_B"], d["w_B"]};
  const Cylinder abdomen{d["m_A"], d["h_A"], d["w_A"]};
  const Eigen::Vector3d joint(d["mu_A"][0], d["mu_A"][1], d["mu_A"][2]);
  WingParameters wing;
  wing.mass = d["m_R"];
  const Insect insect = makeButterfly("monarch", body, abdomen, joint, wing, monarchPlanform());
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      expectRelative(insect.J_B(i, k), d["J_B"][i][k], 1e-12, "J_B");
      expectRelative(insect.abdomen.J(i, k), d["J_A"][i][k], 1e-12, "J_A");
    }
    EXPECT_DOUBLE_EQ(insect.abdomen.nu[i], d["nu_A"][i].get<double>());
  }
  expectRelative(insect.totalMass(), d["m"], 1e-12, "total mass");
  EXPECT_TRUE(insect.problems().empty());
}

TEST(Wing, InertiaScalesWithMassAndOffset) {
  const Planform p = Planform::rectangle(0.02, 0.05, 0.25, 0.003);
  const Appendage one = plateWing(p, 1e-5, Eigen::Vector3d::Zero());
  const Appendage three = plateWing(p, 3e-5, Eigen::Vector3d::Zero());
  EXPECT_LT((three.J - 3.0 * one.J).norm(), 1e-15 * three.J.norm() + 1e-25);
  EXPECT_LT((three.nu - one.nu).norm(), 1e-17);
  // Rectangle about an edge offset: m (b^2/12 + yc^2) and m (c^2/12 + xc^2).
  const double yc = 0.003 + 0.025, xc = 0.005 - 0.01;
  expectRelative(one.J(0, 0), 1e-5 * (0.05 * 0.05 / 12.0 + yc * yc), 1e-12, "J_xx");
  expectRelative(one.J(1, 1), 1e-5 * (0.02 * 0.02 / 12.0 + xc * xc), 1e-12, "J_yy");
  expectRelative(one.J(0, 1), -1e-5 * xc * yc, 1e-12, "J_xy");
  expectRelative(one.J(2, 2), one.J(0, 0) + one.J(1, 1), 1e-14, "J_zz");
}

TEST(Insect, EveryFaultIsNamedAtOnce) {
  const Planform p = Planform::rectangle(0.02, 0.05, 0.25);
  WingParameters wing;
  wing.mass = -1.0;
  wing.kappa = -2.0;
  wing.beta = 25.4;
  wing.theta_0 = NAN;
  const Insect insect = makeButterfly("bad", {-1.0, 0.0, 1.0}, {1.0, 1.0, INFINITY},
                                      Eigen::Vector3d(NAN, 0, 0), wing, p);
  std::string all;
  for (const std::string& fault : insect.problems()) all += fault + "\n";
  for (const char* key :
       {"insect/wing/mass = -1 kg", "insect/wing/kappa = -2", "insect/beta = 25.4",
        "insect/wing/theta_0", "insect/body/mass = -1", "insect/body/length = 0",
        "insect/abdomen/width", "insect/abdomen/joint"}) {
    EXPECT_NE(all.find(key), std::string::npos) << key << " in\n" << all;
  }
}

}  // namespace
}  // namespace monarch_flight
