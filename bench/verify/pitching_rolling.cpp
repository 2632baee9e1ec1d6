// Circular plate that rolls about its root and pitches about its mid-chord in a stream, Re 200,
// against two other codes. Bounds: docs/verification.md, "References from outside".
#include "verify/setup.h"
#include "verify/subjects.h"
#include "verify/table.h"

namespace monarch_flight::verify {
namespace {

constexpr double kReynolds = 200, kStrouhal = 0.6, kAmplitude = M_PI / 4;
constexpr double kSpan = M_PI / 4 * 1.27, kArea = M_PI / 4 * kSpan;  // chord and speed are 1
constexpr double kOmega = 2 * M_PI * kStrouhal / (2 * kAmplitude * 0.5 * kSpan);
constexpr int kPeriods = 4;  // the codes compared with publish their fifth
constexpr double kCells[3] = {10, 14, 20}, kSpacing[3] = {1 / 10.0, 1 / 14.0, 1 / 20.0};

/// Coefficients over the last period and the mean thrust of the one before.
struct Cycle {
  std::vector<double> thrust, lift, span;
  double thrust_before = 0;
};

/// The published angles: roll -A cos(w t), pitch -A cos(w t + psi), leading edge up. Up is z here.
WingMotion motionAt(double t, double psi) {
  WingMotion m =
      flapAndPitch(oscillation(kAmplitude, kOmega, t, -M_PI / 2),
                   oscillation(kAmplitude, kOmega, t, psi + M_PI / 2), Vector3d(1, 0, 0));
  m.r_I = Vector3d(t, 0, 0);
  return m;
}

Cycle fly(double psi_degrees, double cells_per_chord) {
  const double psi = psi_degrees * M_PI / 180;
  const auto flow = makeNavierStokes(Planform::ellipse(1, kSpan, 0.5, 0), airOf(1, 1 / kReynolds),
                                     scaled("preview", cells_per_chord, 12));
  const int steps = static_cast<int>(std::lround(12 * cells_per_chord));  // a period
  const double dt = 2 * M_PI / kOmega / steps;
  const auto loads = verify::fly(
      *flow, [&](double t) { return motionAt(t, psi); }, dt, kPeriods * steps);
  Cycle c;
  for (int n = (kPeriods - 2) * steps; n < kPeriods * steps; ++n) {
    const Vector3d F = motionAt((n + 1) * dt, psi).R_IW * loads[n].force() / (0.5 * kArea);
    if (n < (kPeriods - 1) * steps) {
      c.thrust_before += F.x() / steps;
      continue;
    }
    c.thrust.push_back(F.x());
    c.lift.push_back(F.z());
    c.span.push_back(F.y());
  }
  return c;
}

double mean(const std::vector<double>& f) {
  double sum = 0;
  for (double v : f) sum += v;
  return sum / f.size();
}

double rms(const std::vector<double>& f) {
  double sum = 0;
  for (double v : f) sum += v * v;
  return std::sqrt(sum / f.size());
}

/// Root mean square of the difference to a published history over that of the history. Value i
/// belongs to the time (i + 1) / size of the period: ours is the fourth, the published one the
/// fifth, t / T from 4 to 5.
double difference(const std::vector<double>& f, const char* file) {
  const Table table = readTable(file);
  std::vector<double> gap, scale;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double published = table.at(4 + (i + 1.0) / f.size());
    if (std::isnan(published)) continue;
    gap.push_back(f[i] - published);
    scale.push_back(published);
  }
  return rms(gap) / rms(scale);
}

/// Our fourth period is drawn at the place of the published fifth, t / T from 4 to 5.
void histories(Report& report, const Cycle& c, const std::string& resolution) {
  const struct {
    const char *name, *file;
    const std::vector<double>& f;
    double bound;
  } rows[] = {{"CT", "pitching_rolling_ct_li_dong_2016.dat", c.thrust, 0.40},
              {"CL", "pitching_rolling_cl_li_dong_2016.dat", c.lift, 0.25},
              {"CZ", "pitching_rolling_cz_li_dong_2016.dat", c.span, 0.25}};
  for (const auto& row : rows) {
    report.below(std::string(row.name) + " history, Li and Dong", resolution,
                 difference(row.f, row.file), row.bound);
    const Table t = readTable(row.file);
    report.curve({"pitching_rolling", "t / T", "coefficient", std::string(row.name) + ", Li, Dong",
                  t.x, t.y, false});
    Curve own{"pitching_rolling", "t / T", "coefficient", row.name, {}, row.f, false};
    for (std::size_t i = 0; i < row.f.size(); ++i) own.x.push_back(4 + (i + 1.0) / row.f.size());
    report.curve(std::move(own));
  }
}

/// PetIBM's finest grid: mean thrust, and lift and spanwise force, root mean square.
void baseline(Report& report) {
  double thrust[3], lift[3], span[3];
  for (int i = 0; i < 3; ++i) {
    const std::string resolution = text("%g cells a chord", kCells[i]);
    const Cycle c = fly(90, kCells[i]);
    thrust[i] = mean(c.thrust), lift[i] = rms(c.lift), span[i] = rms(c.span);
    report.state("CT, mean; the period before", resolution, thrust[i], c.thrust_before);
    if (i < 2) {
      report.state("CT, mean, PetIBM", resolution, thrust[i], 0.986);
      report.state("CL, rms, PetIBM", resolution, lift[i], 2.817);
      report.state("CZ, rms, PetIBM", resolution, span[i], 1.601);
      continue;
    }
    report.near("CT, mean, PetIBM", resolution, thrust[i], 0.986, 0.08, 2.66);  // of the peak
    report.near("CL, rms, PetIBM", resolution, lift[i], 2.817, 0.08);
    report.near("CZ, rms, PetIBM", resolution, span[i], 1.601, 0.09);
    report.state("CT, mean, Li and Dong", resolution, thrust[i], 1.462);
    report.state("CL, rms, Li and Dong", resolution, lift[i], 3.417);
    report.state("CZ, rms, Li and Dong", resolution, span[i], 1.912);
    histories(report, c, resolution);
  }
  const Extrapolated t = extrapolate(kSpacing, thrust), l = extrapolate(kSpacing, lift),
                     z = extrapolate(kSpacing, span);
  report.state("CT against extrapolated", "20 cells a chord", thrust[2], t.value);
  report.state("CL against extrapolated", "20 cells a chord", lift[2], l.value);
  report.state("CZ against extrapolated", "20 cells a chord", span[2], z.value);
}

}  // namespace

void pitchingRolling(Report& report) {
  baseline(report);
  const double low = mean(fly(60, kCells[1]).thrust), high = mean(fly(120, kCells[1]).thrust);
  report.state("CT, mean, psi 60, PetIBM", "14 cells a chord", low, 0.2114);
  report.state("CT, mean, psi 120, PetIBM", "14 cells a chord", high, 1.4904);
  report.near("CT, psi 120 - psi 60, PetIBM", "14 cells a chord", high - low, 1.279, 0.15);
}

}  // namespace monarch_flight::verify
