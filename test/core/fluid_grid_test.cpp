// The grid around a planform: where its faces lie, how they stretch, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "monarch_flight/fluid/grid.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight {
namespace {

// Fore and hind wing of the monarch, cm (FWUAV, morp_MONARCH.m), at span 5.2 cm and area 15.2 cm^2.
Planform monarch() {
  const std::vector<double> y{0.0,  0.4475, 0.895, 1.3425, 1.79, 2.2375, 2.685, 3.1325,
                              3.58, 4.0275, 4.475, 4.9225, 5.37, 5.8175, 6.0997};
  const std::vector<double> leading{0.0329, 0.2329, 0.3974, 0.5329, 0.6595, 0.765,  0.8822, 0.9702,
                                    1.0346, 1.0727, 1.0815, 1.0845, 1.0933, 0.9614, 0.7621};
  const std::vector<double> trailing{-0.1391, -0.4632, -0.9286, -1.4394, -1.9591,
                                     -2.4669, -2.7806, -2.5434, -2.1144, -1.6122,
                                     -0.808,  -0.4569, -0.1829, 0.2154,  0.4302};
  return Planform::polynomial(y, leading, trailing).scaledTo(0.052, 15.2e-4);
}

double wingArea(const Grid& grid) {
  double area = 0.0;
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      if (grid.isWing(i, j)) area += grid.x.width[i] * grid.y.width[j];
    }
  }
  return area;
}

bool hasFaceAt(const Axis& axis, double position) {
  return std::any_of(axis.face.begin(), axis.face.end(), [&](double face) {
    return std::abs(face - position) < 1e-12 * (axis.face.back() - axis.face.front());
  });
}

TEST(Axis, CentresWidthsAndGapsFollowFromFaces) {
  const Axis axis = Axis::fromFaces({-1.0, 0.0, 0.5, 2.5});
  ASSERT_EQ(axis.n(), 3);
  EXPECT_EQ(axis.centre, (std::vector<double>{-0.5, 0.25, 1.5}));
  EXPECT_EQ(axis.width, (std::vector<double>{1.0, 0.5, 2.0}));
  EXPECT_EQ(axis.gap, (std::vector<double>{0.5, 0.75, 1.25, 1.0}));
}

TEST(Axis, RefusesFacesThatDoNotIncrease) {
  EXPECT_THROW(Axis::fromFaces({0.0}), std::invalid_argument);
  EXPECT_THROW(Axis::fromFaces({0.0, 1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(Axis::fromFaces({0.0, std::nan("")}), std::invalid_argument);
}

TEST(Grid, RefusesAxesAndMaskThatDoNotFit) {
  const Axis plane = Axis::fromFaces({0.0, 1.0, 2.0}), z = Axis::fromFaces({-1.0, 0.0, 1.0});
  EXPECT_NO_THROW(makeGrid(plane, plane, z, 1, false, std::vector<std::uint8_t>(4, 0)));
  EXPECT_THROW(makeGrid(plane, plane, z, 1, false, std::vector<std::uint8_t>(3, 0)),
               std::invalid_argument);
  EXPECT_THROW(makeGrid(plane, plane, z, 0, false, std::vector<std::uint8_t>(4, 0)),
               std::invalid_argument);
  EXPECT_THROW(makeGrid(plane, plane, plane, 1, false, std::vector<std::uint8_t>(4, 0)),
               std::invalid_argument);
}

/// Of the staircase: integral of x^px y^py over the wing's faces, by their centres.
double staircaseMoment(const Grid& grid, int px, int py) {
  double sum = 0.0;
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      if (!grid.isWing(i, j)) continue;
      sum += std::pow(grid.x.centre[i], px) * std::pow(grid.y.centre[j], py) * grid.x.width[i] *
             grid.y.width[j];
    }
  }
  return sum;
}

GridSettings cellsAcross(const Planform& planform, double cells, double side) {
  GridSettings s = GridSettings::preset("standard");
  s.level = "custom";
  s.cells_per_chord = cells * planform.meanChord() / side;
  return s;
}

TEST(Staircase, HasTheMomentsOfCurvedOutlines) {
  for (double span : {0.7, 1.0, 1.6, 2.0, 2.5, 3.0}) {
    const Planform ellipse = Planform::ellipse(1, span, 0.5, -0.5 * span);
    const double side = std::min(1.0, span);
    const Grid grid = makeGrid(ellipse, cellsAcross(ellipse, 24, side));
    for (auto [px, py, bound] :
         {std::tuple(0, 0, 0.004), std::tuple(2, 0, 0.01), std::tuple(0, 2, 0.01)}) {
      const double exact = ellipse.moment(px, py);
      EXPECT_NEAR(staircaseMoment(grid, px, py), exact, bound * exact)
          << "x^" << px << " y^" << py << ", span " << span;
    }
  }
}

TEST(Staircase, OfASymmetricOutlineIsSymmetric) {
  const Planform ellipse = Planform::ellipse(1, 2.3, 0.5, -1.15);
  const Grid grid = makeGrid(ellipse, cellsAcross(ellipse, 20, 1));
  for (int j = 0; j < grid.y.n(); ++j) {
    for (int i = 0; i < grid.x.n(); ++i) {
      ASSERT_EQ(grid.isWing(i, j), grid.isWing(i, grid.y.n() - 1 - j)) << i << ' ' << j;
      ASSERT_EQ(grid.isWing(i, j), grid.isWing(grid.x.n() - 1 - i, j)) << i << ' ' << j;
    }
  }
}

TEST(GridPresets, CountCellsForTheMonarchAsPromised) {
  const struct {
    const char* level;
    double fewest, most;
  } levels[] = {{"preview", 0.2e6, 0.3e6}, {"standard", 0.65e6, 1.3e6}, {"fine", 2.5e6, 5e6}};
  for (const auto& l : levels) {
    const Grid grid = makeGrid(monarch(), GridSettings::preset(l.level));
    EXPECT_GE(grid.cells(), l.fewest) << l.level;
    EXPECT_LE(grid.cells(), l.most) << l.level;
    EXPECT_NEAR(wingArea(grid), 15.2e-4, 0.002 * 15.2e-4) << l.level;
    EXPECT_FALSE(grid.open);
  }
}

class GridOfLevel : public testing::TestWithParam<const char*> {};

TEST_P(GridOfLevel, HasFacesOnTheBoxOfTheOutlineAndInTheWingsPlane) {
  const Planform wing = monarch();
  const Grid grid = makeGrid(wing, GridSettings::preset(GetParam()));
  EXPECT_TRUE(hasFaceAt(grid.x, wing.xMin()));
  EXPECT_TRUE(hasFaceAt(grid.x, wing.xMax()));
  EXPECT_TRUE(hasFaceAt(grid.y, wing.yRoot()));
  EXPECT_TRUE(hasFaceAt(grid.y, wing.yTip()));
  EXPECT_EQ(grid.z.face[grid.k_wing], 0.0);
  EXPECT_EQ(grid.k_wing, grid.z.n() / 2);
}

TEST_P(GridOfLevel, IsSymmetricAboutTheBoxAndReachesTheFarField) {
  const Planform wing = monarch();
  const Grid grid = makeGrid(wing, GridSettings::preset(GetParam()));
  const double far = 10.0 * wing.meanChord(), tiny = 1e-12 * far;
  const struct {
    const Axis& axis;
    double low, high;
  } axes[] = {
      {grid.x, wing.xMin(), wing.xMax()}, {grid.y, wing.yRoot(), wing.yTip()}, {grid.z, 0, 0}};
  for (const auto& a : axes) {
    const int n = a.axis.n();
    EXPECT_EQ(n % 2, 0);
    EXPECT_NEAR(a.axis.face.front(), a.low - far, tiny);
    EXPECT_NEAR(a.axis.face.back(), a.high + far, tiny);
    for (int i = 0; i <= n; ++i) {
      EXPECT_NEAR(a.axis.face[i] + a.axis.face[n - i], a.low + a.high, 2 * tiny);
    }
  }
}

TEST_P(GridOfLevel, StretchesSlowlyAtTheWingAndSmoothlyElsewhere) {
  const Planform wing = monarch();
  const GridSettings settings = GridSettings::preset(GetParam());
  const Grid grid = makeGrid(wing, settings);
  const double chord = wing.meanChord();
  auto ratio = [](const Axis& axis, int i) { return axis.width[i] / axis.width[i - 1]; };
  for (int i = grid.x.n() / 2 + 1; i < grid.x.n(); ++i) {
    const bool near = grid.x.face[i + 1] < wing.xMax() + settings.margin * chord;
    EXPECT_LE(ratio(grid.x, i), near ? 1.0 + 1e-9 : settings.growth_plane + 1e-9) << i;
    if (!near) {
      EXPECT_LE(ratio(grid.x, i) - ratio(grid.x, i - 1), 0.0301) << i;
    }
  }
  for (int k = grid.k_wing + 1; k < grid.z.n(); ++k) {
    const bool near = grid.z.face[k] < 0.3 * chord;
    EXPECT_LE(ratio(grid.z, k), near ? 1.1 : settings.growth_normal + 1e-9) << k;
    if (k > grid.k_wing + 1) {
      EXPECT_LE(ratio(grid.z, k) - ratio(grid.z, k - 1), 0.0301) << k;
    }
  }
  EXPECT_NEAR(grid.z.width[grid.k_wing], settings.first_cell * chord, 1e-9 * chord);
  EXPECT_NEAR(grid.x.width[grid.x.n() / 2], chord / settings.cells_per_chord,
              0.05 * chord / settings.cells_per_chord);
}

INSTANTIATE_TEST_SUITE_P(Levels, GridOfLevel, testing::Values("preview", "standard", "fine"));

TEST(Grid, OfALargerWingIsTheSameGridLarger) {
  const GridSettings settings = GridSettings::preset("preview");
  const Grid small = makeGrid(Planform::ellipse(0.02, 0.05, 0.3), settings);
  const Grid large = makeGrid(Planform::ellipse(2.0, 5.0, 0.3), settings);
  ASSERT_EQ(small.cells(), large.cells());
  EXPECT_EQ(small.wing, large.wing);
  for (int i = 0; i <= small.x.n(); ++i) {
    EXPECT_NEAR(100.0 * small.x.face[i], large.x.face[i], 1e-11 * large.x.face.back());
  }
}

TEST(Grid, BlocksARectangleExactlyAndKeysOverrideThePreset) {
  GridSettings settings = GridSettings::preset("standard");
  settings.cells_per_chord = 20;
  settings.far_field = 12;
  settings.outer = "open";
  const Grid grid = makeGrid(Planform::rectangle(0.5, 1.0, 0.25, 0.1), settings);
  EXPECT_NEAR(wingArea(grid), 0.5, 1e-12);
  EXPECT_EQ(std::count(grid.wing.begin(), grid.wing.end(), 1), 20 * 40);
  EXPECT_NEAR(grid.z.face.back(), 6.0, 1e-12);
  EXPECT_TRUE(grid.open);
}

TEST(Grid, StaircaseAreaOfAnEllipseConverges) {
  const Planform ellipse = Planform::ellipse(1.0, 2.0, 0.5);
  GridSettings settings;
  const struct { double cells, bound; } cases[] = {{12, 0.03}, {48, 0.01}, {96, 0.003}};
  for (const auto& c : cases) {
    settings.cells_per_chord = c.cells;
    EXPECT_NEAR(wingArea(makeGrid(ellipse, settings)) / ellipse.area(), 1.0, c.bound) << c.cells;
  }
}

TEST(Grid, WithoutStretchingEndsOnTheFarFieldToo) {
  GridSettings settings;
  settings.growth_plane = settings.growth_normal = 1.0;
  settings.first_cell = 0.15;
  settings.cells_per_chord = 6;
  settings.far_field = 2.0;
  const Grid grid = makeGrid(Planform::rectangle(1.0, 1.0, 0.5), settings);
  EXPECT_NEAR(grid.z.face.back(), 2.0, 1e-12);
  EXPECT_NEAR(grid.x.face.back(), 2.5, 1e-12);
  EXPECT_NEAR(grid.z.width.front(), grid.z.width.back(), 1e-12);
}

TEST(GridSettings, NamesEveryFaultAtOnce) {
  GridSettings settings;
  EXPECT_TRUE(settings.problems().empty());
  settings.cells_per_chord = -1;
  settings.first_cell = std::numeric_limits<double>::quiet_NaN();
  settings.growth_plane = 0.9;
  settings.far_field = 0.0;
  settings.outer = "periodic";
  settings.courant_limit = -3;
  const auto faults = settings.problems();
  auto names = [&](const std::string& key) {
    return std::any_of(faults.begin(), faults.end(), [&](const std::string& f) {
      return f.rfind("grid/" + key + " = ", 0) == 0 && f.find("must be") != std::string::npos;
    });
  };
  for (const char* key : {"cells_per_chord", "first_cell", "growth_plane", "far_field", "margin",
                          "outer", "courant_limit"}) {
    EXPECT_TRUE(names(key)) << key;
  }
  EXPECT_FALSE(names("growth_normal"));
  EXPECT_THROW(makeGrid(monarch(), settings), InputError);
  EXPECT_THROW(GridSettings::preset("ultra"), InputError);
}

TEST(Grid, RefusesAWingThatItCannotResolveAndSettingsThatItCannotHold) {
  GridSettings settings;
  settings.cells_per_chord = 5;
  EXPECT_THROW(makeGrid(Planform::rectangle(1.0, 0.2, 0.5), settings), InputError);
  try {
    makeGrid(Planform::rectangle(1.0, 0.2, 0.5), settings);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("grid/cells_per_chord = 5"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("span"), std::string::npos);
  }
  settings.cells_per_chord = 400;
  EXPECT_THROW(makeGrid(Planform::rectangle(1.0, 1.0, 0.5), settings), InputError);
}

}  // namespace
}  // namespace monarch_flight
