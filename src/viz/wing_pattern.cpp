#include "viz/wing_pattern.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "viz/marker.h"

namespace monarch_flight {
namespace {

using Eigen::Vector2d;
using Line = std::vector<Vector2d>;

/// The pen: what it draws lies on the wing or, `lift` [m] off its plane, on both of its sides.
class Pen {
 public:
  Pen(bool left, visualization_msgs::Marker& out) : mirror_(left ? -1.0 : 1.0), out_(out) {}

  void quad(const std::array<Vector2d, 4>& p, const std::array<std_msgs::ColorRGBA, 4>& c,
            double z = 0.0) {
    std::array<Corner, 4> k;
    for (std::size_t i = 0; i < 4; ++i)
      k[i] = {Eigen::Vector3d(p[i].x(), mirror_ * p[i].y(), z).cast<float>(), c[i]};
    addTriangle(out_, k[0], k[1], k[2]);
    addTriangle(out_, k[0], k[2], k[3]);
  }
  /// Along a line, from `width` to `end` wide.
  void stroke(const Line& line, double width, double end, const std_msgs::ColorRGBA& c,
              double lift) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Vector2d along = (line[i + 1] - line[i]).normalized(), across(-along.y(), along.x());
      const auto half = [&](std::size_t at) -> Vector2d {
        const double s = double(at) / double(line.size() - 1);
        return 0.5 * (width + s * (end - width)) * across;
      };
      const std::array<Vector2d, 4> p = {line[i] - half(i), line[i] + half(i),
                                         line[i + 1] + half(i + 1), line[i + 1] - half(i + 1)};
      for (double z : {-lift, lift}) quad(p, {c, c, c, c}, z);
    }
  }
  void disc(const Vector2d& centre, double radius, const std_msgs::ColorRGBA& c, double lift) {
    constexpr int kSides = 8;
    const auto at = [&](int i) -> Vector2d {
      const double angle = 2.0 * M_PI * i / kSides;
      return centre + radius * Vector2d(std::cos(angle), std::sin(angle));
    };
    for (int i = 0; i < kSides; i += 2)
      for (double z : {-lift, lift}) quad({centre, at(i), at(i + 1), at(i + 2)}, {c, c, c, c}, z);
  }

 private:
  double mirror_;
  visualization_msgs::Marker& out_;
};

/// A wing in coordinates that its outline bounds: s from root to tip, u from the trailing to the
/// leading edge, both from 0 to 1.
struct Outline {
  const Planform& wing;
  double chord;  // mean [m]

  explicit Outline(const Planform& planform) : wing(planform), chord(planform.meanChord()) {}
  double chordAt(double s) const { return std::max(0.0, wing.chord(y(s))); }
  double y(double s) const { return wing.yRoot() + s * wing.span(); }
  Vector2d at(double s, double u) const { return {wing.trailing(y(s)) + u * chordAt(s), y(s)}; }
  /// The nearest point along the chord that lies `rim` [m] or more within the outline.
  Vector2d within(const Vector2d& p, double rim) const {
    const double s = std::clamp((p.y() - wing.yRoot()) / wing.span(), 0.0, 1.0);
    const double low = wing.trailing(y(s)) + rim, high = wing.leading(y(s)) - rim;
    return {low < high ? std::clamp(p.x(), low, high) : 0.5 * (low + high), y(s)};
  }
  /// Points at equal distances around the tip, from s = `from` on the leading edge to `to` on the
  /// trailing edge, `rim` [m] within the outline.
  Line aroundTheTip(double from, double to, int count, double rim) const {
    constexpr int kFine = 200;
    Line fine;
    for (int i = 0; i <= kFine; ++i) fine.push_back(at(from + (1.0 - from) * tip(i, kFine), 1.0));
    for (int i = kFine; i-- > 0;) fine.push_back(at(to + (1.0 - to) * tip(i, kFine), 0.0));
    return evenly(inset(fine, rim), count);
  }

 private:
  // Closer together towards the tip, where the outline turns.
  static double tip(int i, int count) { return std::sin(0.5 * M_PI * i / count); }

  /// Moved into the wing.
  static Line inset(const Line& line, double rim) {
    Line out;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::size_t a = i > 2 ? i - 3 : 0, b = std::min(i + 3, line.size() - 1);
      const Vector2d along = (line[b] - line[a]).normalized();
      out.push_back(line[i] + rim * Vector2d(-along.y(), along.x()));
    }
    return out;
  }

  static Line evenly(const Line& line, int count) {
    std::vector<double> length(1, 0.0);
    for (std::size_t i = 1; i < line.size(); ++i)
      length.push_back(length.back() + (line[i] - line[i - 1]).norm());
    Line out;
    std::size_t i = 0;
    for (int n = 0; n < count; ++n) {
      const double goal = length.back() * n / (count - 1);
      while (i + 2 < line.size() && length[i + 1] < goal) ++i;
      const double piece = length[i + 1] - length[i];
      const double share = piece > 0.0 ? std::clamp((goal - length[i]) / piece, 0.0, 1.0) : 0.0;
      out.push_back(line[i] + share * (line[i + 1] - line[i]));
    }
    return out;
  }
};

/// Width of the dark border at the trailing and at the leading edge, as a share of the chord there.
struct Border {
  double trailing, leading;
};

Border borderAt(const Outline& outline, double s) {
  const double c = outline.chordAt(s), tip = std::clamp((s - 0.6) / 0.4, 0.0, 1.0);
  const double wide = outline.chord * (0.11 + 0.16 * tip * tip);
  const auto share = [c](double width) { return c > 0.0 ? std::min(0.5, width / c) : 0.5; };
  return {share(wide), share(0.35 * wide + 0.6 * wide * tip * tip)};
}

/// Rows along the span of cells between the borders, which are dark.
void monarchGround(const Outline& outline, Pen& pen) {
  constexpr int kRows = 56, kCells = 3;
  const std_msgs::ColorRGBA dark = colour(0.07f, 0.05f, 0.05f);
  const auto orange = [](double s) {
    return colour(0.96f - 0.10f * float(s), 0.52f - 0.16f * float(s), 0.10f);
  };
  const auto station = [](int i) { return 0.5 * (1.0 - std::cos(M_PI * i / kRows)); };
  for (int i = 0; i < kRows; ++i) {
    const double s = station(i), t = station(i + 1);
    const Border here = borderAt(outline, s), there = borderAt(outline, t);
    const auto strip = [&](double a, double b, double c, double d, bool rim) {
      const auto hue = [&](double at) { return rim ? dark : orange(at); };
      pen.quad({outline.at(s, a), outline.at(s, b), outline.at(t, d), outline.at(t, c)},
               {hue(s), hue(s), hue(t), hue(t)});
    };
    strip(0.0, here.trailing, 0.0, there.trailing, true);
    for (int j = 0; j < kCells; ++j) {
      const auto at = [j](const Border& b, int k) {
        return b.trailing + (1.0 - b.leading - b.trailing) * (j + k) / kCells;
      };
      strip(at(here, 0), at(here, 1), at(there, 0), at(there, 1), false);
    }
    strip(1.0 - here.leading, 1.0, 1.0 - there.leading, 1.0, true);
  }
}

void clearGround(const Outline& outline, Pen& pen) {
  constexpr int kRows = 56;
  const std_msgs::ColorRGBA pale = colour(0.72f, 0.80f, 0.86f, 0.45f);
  const auto station = [](int i) { return 0.5 * (1.0 - std::cos(M_PI * i / kRows)); };
  for (int i = 0; i < kRows; ++i) {
    const double s = station(i), t = station(i + 1);
    pen.quad({outline.at(s, 0), outline.at(s, 1), outline.at(t, 1), outline.at(t, 0)},
             {pale, pale, pale, pale});
  }
}

/// From the root two veins bound the discal cell; from its end the others run to the rim.
void veins(const Outline& outline, double width, const std_msgs::ColorRGBA& c, Pen& pen) {
  constexpr int kVeins = 12, kPieces = 10;
  constexpr double kCell = 0.42;  // end of the discal cell, of the way to the rim
  const double lift = 0.001 * outline.chord, rim = 0.02 * outline.chord;
  const Vector2d root = outline.within(outline.at(0.0, 0.7), rim);
  const Line ends = outline.aroundTheTip(0.5, 0.06, kVeins, 0.0);
  Line cell;
  for (int n = 0; n < kVeins; ++n) {
    const Vector2d start = root + kCell * (ends[std::size_t(n)] - root);
    const bool side = n == 2 || n == kVeins - 4, free = n < 2 || n > kVeins - 4;
    Line line;
    for (int i = 0; i <= kPieces; ++i) {
      const double t = double(i) / kPieces;
      const Vector2d from = side || free ? root : start;
      const Vector2d bend = 0.12 * t * (1.0 - t) * outline.chord * Vector2d(1.0, 0.0);
      line.push_back(outline.within(from + t * (ends[std::size_t(n)] - from) + bend, 0.2 * rim));
    }
    pen.stroke(line, width, 0.6 * width, c, lift);
    if (n >= 2 && n <= kVeins - 4) cell.push_back(outline.within(start, rim));
  }
  pen.stroke(cell, 0.8 * width, 0.8 * width, c, lift);
}

/// Two rows of white spots in the border, and larger ones before the tip.
void spots(const Outline& outline, Pen& pen) {
  const std_msgs::ColorRGBA white = colour(0.97f, 0.95f, 0.90f);
  const double lift = 0.002 * outline.chord, size = 0.016 * outline.chord;
  for (int row = 0; row < 2; ++row) {
    const Line line = outline.aroundTheTip(0.86, 0.05, row == 0 ? 34 : 30,
                                           (row == 0 ? 0.030 : 0.075) * outline.chord);
    for (const Vector2d& at : line)
      pen.disc(outline.within(at, size), row == 0 ? 0.8 * size : size, white, lift);
  }
  const std_msgs::ColorRGBA pale = colour(0.98f, 0.85f, 0.60f);
  for (double s : {0.78, 0.83, 0.88})
    pen.disc(outline.at(s, 0.78 - 0.5 * (s - 0.78)), 1.9 * size, pale, lift);
}

}  // namespace

void addWing(const Planform& planform, bool left, WingLook look, visualization_msgs::Marker& out) {
  const Outline outline(planform);
  Pen pen(left, out);
  if (look == WingLook::kMonarch) {
    monarchGround(outline, pen);
    veins(outline, 0.02 * outline.chord, colour(0.08f, 0.05f, 0.04f), pen);
    spots(outline, pen);
  } else {
    clearGround(outline, pen);
    veins(outline, 0.014 * outline.chord, colour(0.35f, 0.27f, 0.20f), pen);
  }
}

}  // namespace monarch_flight
