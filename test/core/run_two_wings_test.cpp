// Flights with a flow for each wing: symmetric ones against mirrored wings, and every flight
// against its mirror image, bit for bit.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <functional>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/state_hash.h"

namespace monarch_flight {
namespace {

using Edit = std::function<void(YAML::Node&)>;

/// A shipped case with some of its keys changed.
Case edited(const std::string& name, const CaseOverrides& overrides, const Edit& edit) {
  YAML::Node root = YAML::Load(loadCase(name, overrides, CONFIG_DIR).resolved_yaml);
  edit(root);
  return caseFromText(YAML::Dump(root), name, {}, CONFIG_DIR);
}

struct History : StepSink {
  std::vector<CommittedStep> steps;
  std::string failure;
  void onStep(const CommittedStep& step) override { steps.push_back(step); }
  void onReset() override { steps.clear(); }
  void onEnd(const std::string& text) override { failure = text; }
};

std::vector<CommittedStep> flown(const Case& c) {
  History history;
  const StopFlag stop{false};
  InProcessFederation(c).run(1, {&history}, stop);
  EXPECT_EQ(history.failure, "");
  return history.steps;
}

const CaseOverrides kQuick{{"fluid", "quasi_steady"}, {"steps_per_flap", "250"}, {"flaps", "2"}};

void setFree(YAML::Node& root) {
  for (const char* key : {"y", "roll", "yaw"}) root["free"][key] = true;
}

void expectSame(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const char* what, unsigned n) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a(i), b(i)) << what << '[' << i << "], step " << n;
}

void expectSame(const Loads& a, const Loads& b, unsigned n) {
  expectSame(a.force(), b.force(), "force", n);
  expectSame(a.moment(), b.moment(), "moment", n);
}

void expectSame(const BodyState& a, const BodyState& b, unsigned n) {
  expectSame(a.x, b.x, "x", n);
  expectSame(a.v, b.v, "v", n);
  expectSame(a.a, b.a, "a", n);
  expectSame(a.Omega_B, b.Omega_B, "Omega", n);
  EXPECT_EQ(a.q_IB.coeffs(), b.q_IB.coeffs()) << "attitude, step " << n;
}

/// A symmetric flight with wings of their own is the mirrored one.
void expectMirrored(const Case& mirrored, const Case& independent) {
  const auto one = flown(mirrored), two = flown(independent);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t n = 0; n < one.size() && !::testing::Test::HasFailure(); ++n) {
    expectSame(one[n].interface.body, two[n].interface.body, one[n].step);
    EXPECT_EQ(one[n].interface.theta.right.q, two[n].interface.theta.right.q) << n;
    EXPECT_EQ(one[n].interface.theta.right.q, two[n].interface.theta.left.q) << n;
    expectSame(one[n].loads.right, two[n].loads.right, one[n].step);
    expectSame(one[n].loads.right, two[n].loads.left, one[n].step);
    EXPECT_EQ(one[n].iterations.size(), two[n].iterations.size()) << n;
  }
}

TEST(TwoWings, SymmetricFlightIsTheMirroredOneInTheSameCoordinates) {
  const Case mirrored = loadCase("climb_printed", kQuick, CONFIG_DIR);
  expectMirrored(mirrored, edited("climb_printed", kQuick,
                                  [](YAML::Node& root) { root["wings"] = "independent"; }));
}

TEST(TwoWings, SymmetricFlightIsTheMirroredOneInAllCoordinates) {
  const Case mirrored = loadCase("climb_printed", kQuick, CONFIG_DIR);
  expectMirrored(mirrored, edited("climb_printed", kQuick, [](YAML::Node& root) {
                   root["wings"] = "independent";
                   setFree(root);
                 }));
}

TEST(TwoWings, SymmetricFlightIsTheMirroredOneInNavierStokesAir) {
  const CaseOverrides few{{"fluid", "navier_stokes"}, {"steps_per_flap", "500"}, {"flaps", "1"}};
  const auto coarse = [](YAML::Node& root) {
    root["grid"]["level"] = "custom";
    root["grid"]["cells_per_chord"] = 6;
    root["grid"]["first_cell"] = 0.1;
    root["grid"]["far_field"] = 4;
    root["grid"]["growth_plane"] = 1.5;
    root["grid"]["growth_normal"] = 1.5;
    root["time"]["flaps"] = 0.08;
  };
  expectMirrored(edited("climb_printed", few, coarse),
                 edited("climb_printed", few, [&coarse](YAML::Node& root) {
                   coarse(root);
                   root["wings"] = "independent";
                   setFree(root);
                 }));
}

/// A flight that is anything but symmetric, or its mirror image.
Case asymmetric(bool image) {
  const double sign = image ? -1.0 : 1.0;
  return edited("climb_printed", kQuick, [image, sign](YAML::Node& root) {
    root["wings"] = "independent";
    setFree(root);
    YAML::Node damaged = root["insect"][image ? "right_wing" : "left_wing"];
    damaged["tip_lost"] = 0.2;
    damaged["kappa"] = 4e-5;
    damaged["hinge_additions"]["damping"] = 1e-7;
    damaged["hinge_additions"]["cubic_stiffness"] = 5e-5;
    root["fluid"]["wind"] = std::vector<double>{0.2, sign * 1.0, -0.1};
    root["initial"]["roll"] = sign * 0.2;
    root["initial"]["yaw_dot"] = sign * -3.0;
  });
}

TEST(TwoWings, EveryFlightHasItsMirrorImage) {
  const auto one = flown(asymmetric(false)), other = flown(asymmetric(true));
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size() && !HasFailure(); ++n) {
    const CommittedStep &a = one[n], &b = other[n];
    expectSame(mirrored(a.interface.body), b.interface.body, a.step);
    EXPECT_EQ(a.interface.theta.right.q, b.interface.theta.left.q) << n;
    EXPECT_EQ(a.interface.theta.left.q, b.interface.theta.right.q) << n;
    expectSame(a.loads.right, b.loads.left, a.step);
    expectSame(a.loads.left, b.loads.right, a.step);
    EXPECT_EQ(a.iterations.size(), b.iterations.size()) << n;
  }
  // It does leave the plane.
  EXPECT_GT(std::abs(one.back().interface.body.x.y()), 1e-2);
  EXPECT_GT(std::abs(rollPitchYaw(one.back().interface.body.R_IB()).x()), 0.1);
}

TEST(TwoWings, SideWindBlowsBothWaysAlike) {
  const auto windy = [](double side) {
    return flown(edited("climb_printed", kQuick, [side](YAML::Node& root) {
      root["wings"] = "independent";
      setFree(root);
      root["fluid"]["wind"] = std::vector<double>{0.0, side, 0.0};
    }));
  };
  const auto right = windy(1.0), left = windy(-1.0);
  ASSERT_EQ(right.size(), left.size());
  for (std::size_t n = 0; n < right.size() && !HasFailure(); ++n)
    expectSame(mirrored(right[n].interface.body), left[n].interface.body, right[n].step);
  EXPECT_GT(right.back().interface.body.v.y(), 0.01);
}

/// Which side is which: the smaller wing, doing the same, has the smaller loads.
TEST(TwoWings, TheDamagedWingHasTheSmallerLoads) {
  const auto held = flown(edited("climb_printed", kQuick, [](YAML::Node& root) {
    root["wings"] = "independent";
    for (const char* key : {"x", "z", "pitch", "wing_pitch"}) root["free"][key] = false;
    root["insect"]["left_wing"]["tip_lost"] = 0.2;
    root.remove("initial");
  }));
  double right = 0.0, left = 0.0;
  for (const CommittedStep& step : held) {
    right += step.loads.right.force().norm();
    left += step.loads.left.force().norm();
  }
  EXPECT_GT(left, 0.3 * right);
  EXPECT_LT(left, 0.8 * right);
}

/// A case of a damaged wing says what is wrong with it.
TEST(TwoWings, FaultsOfOneWingAreNamed) {
  const auto faults = [](const Edit& edit) -> std::string {
    try {
      edited("climb_printed", kQuick, edit);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const auto with = [&](const char* key, double value) {
    return faults([key, value](YAML::Node& root) {
      root["wings"] = "independent";
      root["insect"]["left_wing"][key] = value;
    });
  };
  EXPECT_NE(with("tip_lost", 0.95).find("insect/left_wing/tip_lost = 0.95: must be in [0, 0.9]"),
            std::string::npos);
  EXPECT_NE(with("kappa", -1.0).find("insect/left_wing/kappa = -1 N m/rad: must be >= 0"),
            std::string::npos);
  EXPECT_NE(with("colour", 1.0).find("insect/left_wing/colour"), std::string::npos);
  EXPECT_NE(faults([](YAML::Node& root) {
              root["insect"]["left_wing"]["tip_lost"] = 0.2;
            }).find("set wings to independent"),
            std::string::npos);
  EXPECT_NE(faults([](YAML::Node& root) {
              root["free"]["roll"] = true;
            }).find("free/roll = true: must be false"),
            std::string::npos);
}

/// What is cut off at the tip is lost in area and span, not in the chords that remain.
TEST(TwoWings, ALostTipTakesItsShareOfTheArea) {
  const Planform whole = Planform::ellipse(0.03, 0.05, 0.25);
  const Planform cut = whole.withoutTip(0.2);
  EXPECT_NEAR(cut.area() / whole.area(), 0.8, 1e-9);
  EXPECT_LT(cut.span(), whole.span());
  EXPECT_EQ(cut.chord(0.02), whole.chord(0.02));
  EXPECT_THROW(whole.withoutTip(0.91), std::invalid_argument);
}

/// Sub-iterations with eight unknowns and two flows stay few.
TEST(TwoWings, ConvergesInFewSubIterations) {
  double sum = 0.0;
  std::size_t most = 0, free = 0;
  for (const CommittedStep& step : flown(asymmetric(false))) {
    if (step.prescribed) continue;
    ++free;
    sum += static_cast<double>(step.iterations.size());
    most = std::max(most, step.iterations.size());
  }
  EXPECT_LE(sum / static_cast<double>(free), 2.5);
  EXPECT_LE(most, 5u);
}

}  // namespace
}  // namespace monarch_flight
