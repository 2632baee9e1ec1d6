// Cases that name models of other packages: read anywhere, flown where the plugins are.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/federation.h"
#include "monarch_flight/run/plugins.h"

namespace monarch_flight {
namespace {

/// Remembers what it was asked with.
struct Asked {
  std::string parameters;
  Side side = Side::kRight;
  bool throws = false, null = false;
} asked;

class TestFluid : public FluidPlugin {
 public:
  std::unique_ptr<FluidModel> make(const FluidPluginInput& input) override {
    asked.parameters = input.parameters;
    asked.side = input.side;
    if (asked.throws) throw std::runtime_error("thin: must be a number");
    if (asked.null) return nullptr;
    return makeQuasiSteady(input.planform, input.flown.air, input.flown.blade_element);
  }
};

class TestGuidance : public GuidancePlugin {
 public:
  std::unique_ptr<Guidance> make(const GuidancePluginInput& input) override {
    asked.parameters = input.parameters;
    return std::make_unique<MotionGuidance>(input.flown.motion, input.flown.wind);
  }
};

template <class Plugin, class Made>
PluginSource<Plugin> sourceOf(std::vector<std::string> names) {
  return {[names] { return names; },
          [](const std::string& name) -> std::shared_ptr<Plugin> {
            if (name == "lab/Broken") throw std::runtime_error("libbroken.so: undefined symbol");
            return std::make_shared<Made>();
          }};
}

class Plugins : public testing::Test {
 protected:
  void SetUp() override {
    asked = {};
    setPluginSources({sourceOf<FluidPlugin, TestFluid>({"lab/Air", "lab/Broken"}),
                      sourceOf<GuidancePlugin, TestGuidance>({"lab/Guide"})});
  }
  void TearDown() override { setPluginSources({}); }

  static std::string shipped() {
    std::ifstream file(std::string(CONFIG_DIR) + "/cases/climb_trimmed.yaml");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

  /// climb_trimmed with lines behind those of its section `fluid`.
  static Case withParameters(const std::string& parameters, CaseOverrides overrides) {
    std::string text = shipped();
    const std::string mark = "\nfluid:\n";
    const std::size_t at = text.find(mark);
    EXPECT_NE(at, std::string::npos);
    text.insert(at + mark.size(), parameters);
    return caseFromText(text, "test", overrides, CONFIG_DIR);
  }

  template <class Action>
  static std::string fault(Action action) {
    try {
      action();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

constexpr char kSome[] =
    "  parameters:\n    thin: 0.5\n    text: \"two words\"\n    list: [1, {a: b}]\n    empty:\n";

TEST_F(Plugins, ACaseKeepsItsParameters) {
  const Case c = withParameters(kSome, {{"fluid", "lab/Air"}});
  EXPECT_EQ(fluidName(c), "lab/Air");
  const Case again = caseFromText(c.resolved_yaml, "again", {}, CONFIG_DIR);
  EXPECT_EQ(again.resolved_yaml, c.resolved_yaml);
  EXPECT_EQ(again.fluid_plugin.parameters, c.fluid_plugin.parameters);
  // However it is written.
  EXPECT_EQ(withParameters("  parameters: {thin: '0.5', text: two words, list: [1, {\"a\": b}], "
                           "empty: null}  # as above\n",
                           {{"fluid", "lab/Air"}})
                .sha256,
            c.sha256);
  const Case other = withParameters("  parameters: {thin: 0.6}\n", {{"fluid", "lab/Air"}});
  EXPECT_NE(other.sha256, c.sha256);
  makeFluid(c, Side::kLeft);
  EXPECT_EQ(asked.parameters, c.fluid_plugin.parameters);
  EXPECT_EQ(asked.side, Side::kLeft);
  for (const char* part : {"thin: 0.5", "two words", "a: b"})
    EXPECT_NE(asked.parameters.find(part), std::string::npos) << asked.parameters;
  // Flown otherwise, they are as if they were not there.
  EXPECT_EQ(withParameters(kSome, {{"fluid", "quasi_steady"}}).sha256,
            withParameters("", {{"fluid", "quasi_steady"}}).sha256);
}

TEST_F(Plugins, NoParametersAreAnEmptyMap) {
  const Case c = withParameters("", {{"fluid", "lab/Air"}, {"guidance", "lab/Guide"}});
  EXPECT_EQ(c.fluid_plugin.parameters, "{}");
  makeGuidance(c);
  EXPECT_EQ(asked.parameters, "{}");
  EXPECT_EQ(guidanceName(c.guidance), "lab/Guide");
  EXPECT_EQ(caseFromText(c.resolved_yaml, "again", {}, CONFIG_DIR).sha256, c.sha256);
}

TEST_F(Plugins, FliesAsTheModelThatItMakes) {
  CaseOverrides keys{{"flaps", "0.05"}, {"steps_per_flap", "100"}};
  const auto flown = [&](const char* fluid, const char* guidance) {
    keys["fluid"] = fluid;
    keys["guidance"] = guidance;
    InProcessFederation federation(withParameters("", keys));
    const StopFlag stop{false};
    return federation.run(1, {}, stop).failure;
  };
  EXPECT_EQ(flown("quasi_steady", "motion"), "");
  EXPECT_EQ(flown("lab/Air", "lab/Guide"), "");
}

TEST_F(Plugins, WhatIsWrongIsToldInFull) {
  const Case c = withParameters("", {{"fluid", "lab/Water"}, {"guidance", "lab/Nobody"}});
  const std::string all = fault([&] { requirePlugins(c); });
  EXPECT_NE(all.find("fluid/solver = lab/Water: there is no such plugin: known are lab/Air, "
                     "lab/Broken; correct the name, or build its package"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("guidance/type = lab/Nobody: there is no such plugin: known are lab/Guide;"),
            std::string::npos)
      << all;
  const Case broken = withParameters("", {{"fluid", "lab/Broken"}});
  EXPECT_NE(fault([&] { requirePlugins(broken); }).find("libbroken.so: undefined symbol"),
            std::string::npos);
  const Case air = withParameters("", {{"fluid", "lab/Air"}});
  asked.throws = true;
  EXPECT_EQ(
      fault([&] { makeFluid(air); }),
      "fluid/solver = lab/Air: the plugin makes nothing of this case: thin: must be a number; "
      "correct fluid/parameters, or the plugin");
  asked.throws = false;
  asked.null = true;
  EXPECT_NE(fault([&] { makeFluid(air); }).find("makes nothing of this case"), std::string::npos);
}

TEST_F(Plugins, WithoutASourceACaseIsRead) {
  setPluginSources({});
  const Case c = withParameters("", {{"fluid", "lab/Air"}});
  EXPECT_EQ(
      fault([&] { makeFluid(c); }),
      "fluid/solver = lab/Air: is a plugin, which this program cannot load; fly the case with "
      "monarch fly, or choose one of this package");
}

TEST_F(Plugins, WrongNamesAndParameters) {
  const auto told = [](const std::string& parameters, const std::string& name) {
    return fault([&] { withParameters(parameters, {{"fluid", name}}); });
  };
  EXPECT_NE(told("", "water")
                .find("must be one of navier_stokes, quasi_steady, or a plugin, as "
                      "my_package/MyFluid; choose one"),
            std::string::npos);
  for (const char* name : {"/Air", "lab/", "lab/Air Pump", "../lab/Air", "1/2"})
    EXPECT_NE(told("", name).find("must be package/Name of a plugin"), std::string::npos) << name;
  EXPECT_NE(
      told("  parameters: thin\n", "lab/Air").find("fluid/parameters = 'thin': must be a section"),
      std::string::npos);
}

}  // namespace
}  // namespace monarch_flight
