// The winds of a run against what they are defined to be, and their accelerations against
// differences.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "monarch_flight/insect/gusts.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

using Eigen::Vector3d;

const Vector3d kAmplitude(0.8, -0.4, 1.6);
const Vector3d kRest = Vector3d::Zero();

Wind atTime(const WindModel& wind, double t) { return wind.at(t, kRest, kRest, kRest); }

/// Fourth-order difference of the velocity that is met along a flight x(t).
Vector3d change(const WindModel& wind, const std::function<Vector3d(double)>& x, double t,
                double h) {
  const auto v = [&](double s) { return wind.at(s, x(s), kRest, kRest).v; };
  return (8.0 * (v(t + h) - v(t - h)) - (v(t + 2 * h) - v(t - 2 * h))) / (12.0 * h);
}

NumericTable table(int n, double dt, const std::function<Vector3d(double)>& wind) {
  NumericTable result{"gusty", WindSeries::columns(), {}};
  for (int i = 0; i < n; ++i) {
    const Vector3d w = wind(i * dt);
    result.rows.push_back({i * dt, w.x(), w.y(), w.z()});
  }
  return result;
}

std::string faultsOf(const NumericTable& rows) {
  try {
    WindSeries{rows};
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

Vector3d breeze(double t) {
  return {std::sin(3.0 * t), 0.4 * std::cos(5.0 * t), 0.2 * t * t - 1.0};
}

TEST(TimeGust, IsOneMinusCosine) {
  const TimeGust gust(0.3, 0.2, kAmplitude);
  for (const double t : {-1.0, 0.0, 0.3, 0.5, 0.6, 9.0}) {
    EXPECT_EQ(atTime(gust, t).v.norm() + atTime(gust, t).a.norm(), 0.0) << t;
  }
  EXPECT_LT((atTime(gust, 0.4).v - kAmplitude).norm(), 1e-15);
  EXPECT_LT(atTime(gust, 0.4).a.norm(), 1e-13);
  for (const double t : {0.31, 0.35, 0.4, 0.42, 0.47}) {
    const double u = 2.0 * M_PI * (t - 0.3) / 0.2;
    EXPECT_LT((atTime(gust, t).v - kAmplitude * 0.5 * (1.0 - std::cos(u))).norm(), 1e-15) << t;
    EXPECT_LT((atTime(gust, t).a - kAmplitude * (M_PI / 0.2) * std::sin(u)).norm(), 1e-12) << t;
  }
}

TEST(TimeGust, VelocityAndAccelerationAreContinuous) {
  const TimeGust gust(0.3, 0.2, kAmplitude);
  for (const double edge : {0.3, 0.5}) {
    const double h = 1e-7;
    const Wind before = atTime(gust, edge - h), behind = atTime(gust, edge + h);
    // The acceleration leaves zero at the rate A/2 (2 pi / T)^2, the velocity with its square.
    const double rate = 0.5 * kAmplitude.norm() * std::pow(2.0 * M_PI / 0.2, 2);
    EXPECT_LT((before.v - behind.v).norm(), rate * h * h);
    EXPECT_LT((before.a - behind.a).norm(), 1.01 * rate * h);
  }
}

TEST(PlaceGust, StandsWhereItIsAndBlowsByDepth) {
  const Vector3d begin(2.0, -1.0, 0.5), direction(3.0, 0.0, -4.0);
  const PlaceGust gust(begin, direction, 0.5, kAmplitude);
  const auto at = [&](double depth, const Vector3d& aside, double t) {
    return gust.at(t, begin + depth * direction / 5.0 + aside, kRest, kRest);
  };
  const Vector3d aside(4.0, 7.0, 3.0);  // normal to the direction
  ASSERT_EQ(aside.dot(direction), 0.0);
  EXPECT_LT((at(0.25, kRest, 0.0).v - kAmplitude).norm(), 1e-14);
  EXPECT_LT((at(0.125, aside, 3.0).v - 0.5 * kAmplitude).norm(), 1e-14);
  EXPECT_LT((at(0.4, aside, -3.0).v - at(0.1, kRest, 1.0).v).norm(), 1e-13);
  for (const double depth : {-5.0, -1e-9, 0.5 + 1e-9, 5.0}) {
    EXPECT_EQ(at(depth, kRest, 0.0).v.norm(), 0.0) << depth;
  }
  EXPECT_EQ(at(0.1, kRest, 0.0).a.norm(), 0.0);  // who does not move meets no change
}

TEST(PlaceGust, IsMetAtTheFlightSpeed) {
  const PlaceGust gust({0.4, 0.0, -0.1}, {1.0, 0.0, -0.3}, 0.6, kAmplitude);
  const auto x = [](double t) {
    return Vector3d(1.5 * t + 0.02 * std::sin(20.0 * t), 0.0, -0.5 * t * t);
  };
  const auto v = [](double t) { return Vector3d(1.5 + 0.4 * std::cos(20.0 * t), 0.0, -t); };
  double largest = 0.0;
  for (double t = 0.2; t < 0.9; t += 0.0137) {
    const Vector3d exact = gust.at(t, x(t), v(t), kRest).a;
    EXPECT_LT((exact - change(gust, x, t, 1e-4)).norm(), 1e-4) << t;
    largest = std::max(largest, exact.norm());
  }
  EXPECT_GT(largest, 5.0);
}

TEST(PlaceGust, AtConstantSpeedIsTheGustInTime) {
  const double speed = 2.0;
  const PlaceGust place({0.4, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.6, kAmplitude);
  const TimeGust time(0.2, 0.3, kAmplitude);
  for (double t = 0.0; t < 0.7; t += 0.013) {
    const Wind met = place.at(t, {speed * t, 0, 0}, {speed, 0, 0}, kRest);
    EXPECT_LT((met.v - atTime(time, t).v).norm(), 1e-14);
    EXPECT_LT((met.a - atTime(time, t).a).norm(), 1e-12);
  }
}

TEST(WindSeries, PassesThroughItsSamplesAndIsSmooth) {
  const NumericTable rows = table(41, 0.05, breeze);
  const WindSeries series(rows);
  EXPECT_EQ(series.tBegin(), 0.0);
  EXPECT_EQ(series.tEnd(), 2.0);
  for (const auto& row : rows.rows) {
    EXPECT_LT((atTime(series, row[0]).v - Vector3d(row[1], row[2], row[3])).norm(), 1e-13);
  }
  const auto still = [](double) { return kRest; };
  for (double t = 0.03; t < 1.97; t += 0.0531) {
    EXPECT_LT((atTime(series, t).v - breeze(t)).norm(), 2e-6) << t;
    EXPECT_LT((atTime(series, t).a - change(series, still, t, 1e-4)).norm(), 1e-8) << t;
  }
}

TEST(WindSeries, ReachesAsFarAsItsRows) {
  const WindSeries series(table(41, 0.05, breeze));
  EXPECT_NO_THROW(atTime(series, 2.0 + 1e-12));
  EXPECT_THROW(atTime(series, 2.001), std::out_of_range);
  EXPECT_THROW(atTime(series, -0.001), std::out_of_range);
}

TEST(WindSeries, RefusesTablesThatAreNone) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  };
  has(faultsOf(table(5, 0.1, breeze)), "gusty: 5 rows: must be >= 6");
  NumericTable rows = table(20, 0.1, breeze);
  rows.rows[3][2] = NAN;
  rows.rows[7][0] = INFINITY;
  has(faultsOf(rows), "gusty: row 4, column wy is not a finite number");
  has(faultsOf(rows), "gusty: row 8, column t is not a finite number");
  rows = table(20, 0.1, breeze);
  rows.rows[9][0] = rows.rows[8][0];
  has(faultsOf(rows), "gusty: row 10, column t = 0.8 s: must be > 0.8 s of the row before");
  rows = table(20, 0.1, breeze);
  rows.rows.erase(rows.rows.begin() + 12);
  has(faultsOf(rows), "gusty: row 13, column t = 1.3 s: gap of 0.2 s");
  rows.columns[3] = "w";
  has(faultsOf(rows), "column 'wz' is missing");
}

TEST(WindSum, AddsVelocitiesAndAccelerations) {
  const auto series = std::make_shared<WindSeries>(table(41, 0.05, breeze));
  const auto time = std::make_shared<TimeGust>(0.5, 0.4, kAmplitude);
  const auto place =
      std::make_shared<PlaceGust>(Vector3d(0.5, 0, 0), Vector3d(1, 0, 0), 0.9, Vector3d(0, 0, 2));
  const WindSum sum({std::make_shared<SteadyWind>(Vector3d(1, 2, 3)), series, time, place});
  const Vector3d x(0.8, 0, 0), v(1.3, 0, 0);
  const Wind all = sum.at(0.6, x, v, kRest);
  const Wind a = atTime(*series, 0.6), b = atTime(*time, 0.6), c = place->at(0.6, x, v, kRest);
  EXPECT_LT((all.v - (Vector3d(1, 2, 3) + a.v + b.v + c.v)).norm(), 1e-15);
  EXPECT_LT((all.a - (a.a + b.a + c.a)).norm(), 1e-13);
}

/// Whatever the wind, a wing's speed through the air is at most the one through the range's middle
/// and its spread; and for a gust against the flight that bound is reached.
TEST(WindRange, HoldsEveryVelocityAndNotMuchMore) {
  const auto series = std::make_shared<WindSeries>(table(41, 0.05, breeze));
  const auto time = std::make_shared<TimeGust>(0.5, 0.4, kAmplitude);
  const auto place =
      std::make_shared<PlaceGust>(Vector3d(0.5, 0, 0), Vector3d(1, 0, 0), 0.9, Vector3d(0, 0, 2));
  const WindSum sum({std::make_shared<SteadyWind>(Vector3d(1, 2, 3)), series, time, place});
  for (const WindModel* wind :
       {static_cast<const WindModel*>(series.get()), static_cast<const WindModel*>(time.get()),
        static_cast<const WindModel*>(place.get()), static_cast<const WindModel*>(&sum)}) {
    const WindRange range = wind->range();
    double furthest = 0.0;
    for (double t = 0.0; t <= 2.0; t += 0.0017) {
      for (double x = 0.0; x < 2.0; x += 0.1) {
        const Wind here = wind->at(t, {x, 0, 0}, kRest, kRest);
        furthest = std::max(furthest, (here.v - range.middle).norm());
      }
    }
    EXPECT_LE(furthest, range.spread * (1.0 + 1e-12));
    EXPECT_GT(furthest, (wind == &sum ? 0.5 : 0.9) * range.spread);
  }
  const WindRange range = time->range();
  const Vector3d wing = -3.0 * kAmplitude;  // flies against the gust
  EXPECT_NEAR((wing - range.middle).norm() + range.spread, (wing - kAmplitude).norm(), 1e-14);
  EXPECT_EQ(SteadyWind(Vector3d(1, 2, 3)).range().spread, 0.0);
}

}  // namespace
}  // namespace monarch_flight
