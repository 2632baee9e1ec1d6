// Parameters of a run: command line and parameter server, every fault at once.
#include <XmlRpcValue.h>
#include <gtest/gtest.h>

#include "core/mutation.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/run_parameters.h"
#include "monarch_flight/run/run_keys.h"

namespace monarch_flight {
namespace {

RunParameters fromArguments(std::vector<std::string> arguments) {
  std::vector<char*> argv = {const_cast<char*>("program")};
  for (std::string& a : arguments) argv.push_back(a.data());
  return runParameters(static_cast<int>(argv.size()), argv.data());
}

std::string faultsOf(const std::vector<std::string>& arguments) {
  try {
    fromArguments(arguments);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(RunParameters, CommandLineAndServerMeanTheSame) {
  const RunParameters line =
      fromArguments({"case:=hinge", "flaps:=0.1", "steps_per_flap:=200", "record:=false",
                     "out:=/tmp/x", "ranks:=1", "__name:=other"});
  XmlRpc::XmlRpcValue values;
  values["case"] = "hinge";
  values["flaps"] = 0.1;
  values["steps_per_flap"] = 200;
  values["record"] = false;
  values["out"] = "/tmp/x";
  values["watchdog"] = 2.5;
  values["ranks"] = 1;
  values["grid"] = "";
  values["frame_prefix"] = "a";
  values["stranger"]["rate"] = 1.0;
  const RunParameters server = runParameters(values, "/monarch_flight/");
  for (const RunParameters& p : {line, server}) {
    EXPECT_EQ("hinge", p.name);
    EXPECT_EQ("/tmp/x", p.out);
    EXPECT_EQ((CaseOverrides{{"flaps", "0.1"}, {"steps_per_flap", "200"}, {"record", "false"}}),
              p.overrides);
  }
  EXPECT_EQ(loadCase(line).sha256, loadCase(server).sha256);
  EXPECT_EQ(2.5, server.watchdog_s);
  EXPECT_EQ(2.5, loadCase(server).watchdog_s);
}

TEST(RunParameters, EveryFaultIsNamedAtOnce) {
  const std::string faults = faultsOf({"flap:=3", "ranks:=two", "watchdog:=5", "nonsense",
                                       "case:=a", "case:=b", "checkpoints:=/tmp", "flaps:="});
  EXPECT_NE(std::string::npos, faults.find("flap: unknown parameter; known are case")) << faults;
  EXPECT_NE(std::string::npos, faults.find("ranks = two: must be a whole number"));
  EXPECT_NE(std::string::npos, faults.find("watchdog: unknown parameter"));
  EXPECT_NE(std::string::npos, faults.find("checkpoints: unknown parameter"));
  EXPECT_NE(std::string::npos, faults.find("'flaps:=': has no value"));
  EXPECT_NE(std::string::npos, faults.find("'nonsense': must be key:=value"));
  EXPECT_NE(std::string::npos, faults.find("'case:=b': this key is given twice"));
}

/// Every key of the table has a place, for whoever takes it.
TEST(RunParameters, EveryKeyOfTheTableIsKnown) {
  const std::map<std::string, std::string> samples = {
      {"truth", "true"}, {"number", "2"}, {"count", "1"}, {"path", "x"}, {"case", "hinge"}};
  int known = 0;
  for (const RunKey& key : runKeys(CONFIG_DIR)) {
    const std::string value = key.choices.empty()
                                  ? samples.count(key.type) ? samples.at(key.type) : "x"
                                  : key.choices.front();
    for (const std::string where : {"", "/monarch_flight/"}) {
      const bool taken = key.takenBy(where.empty() ? "program" : "server");
      known += taken;
      if (taken) {
        EXPECT_NO_THROW(runParameters({{key.name, value}}, where)) << where << key.name;
      } else {
        EXPECT_THROW(runParameters({{key.name, value}}, where), InputError) << where << key.name;
      }
    }
  }
  EXPECT_GT(known, 30);
}

TEST(RunParameters, NothingSetMeansTheShippedFlight) {
  XmlRpc::XmlRpcValue none;
  const RunParameters p = runParameters(none, "/monarch_flight/");
  EXPECT_EQ("climb_controlled", p.name);
  EXPECT_TRUE(p.overrides.empty());
  EXPECT_EQ(0.0, p.watchdog_s);
}

TEST(RunParameters, ListsAreRefusedAndPrivateParametersLeftAlone) {
  XmlRpc::XmlRpcValue values;
  values["flaps"][0] = 1;
  values["fluid"]["density"] = 1.0;
  try {
    runParameters(values, "/monarch_flight/");
    FAIL();
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_NE(std::string::npos, what.find("/monarch_flight/flaps: must be a number")) << what;
    EXPECT_EQ(std::string::npos, what.find("density")) << what;
  }
}

/// 2,000 broken command lines: read, or refused with a message.
TEST(RunParameters, BrokenCommandLinesAreReadOrRefused) {
  Mutation mutation(7);
  const char* const good[] = {"case:=hinge", "flaps:=0.1",    "steps_per_flap:=200", "ranks:=2",
                              "plan:=true",  "paused:=false", "fluid:=quasi_steady"};
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::string> arguments;
    const int count = 1 + mutation.pick(3);
    for (int k = 0; k < count; ++k) arguments.push_back(mutation(good[mutation.pick(7)]));
    for (std::string& a : arguments) a = std::string(a.c_str());  // as the system hands them over
    try {
      fromArguments(arguments);
    } catch (const InputError& e) {
      ++refused;
      EXPECT_GT(std::string(e.what()).size(), 10u);
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(PlannedRun, NodesAndSeveralProcessesMustWaitLongEnough) {
  RunParameters p = runParameters({{"case", "tethered_fwuav"}, {"grid", "preview"}}, "");
  Case c = loadCase(p);
  c.watchdog_s = 1e-6;
  EXPECT_NO_THROW(plannedRun(p, c, false));
  EXPECT_THROW(plannedRun(p, c, true), InputError);
  p.ranks = 2;
  EXPECT_THROW(plannedRun(p, c, false), InputError);
}

TEST(OutputDirectory, StartsWhereTheRunWasCalled) {
  Case c;
  c.name = "climb";
  RunParameters p;
  p.directory = "/somewhere";
  p.out = "there/../here";
  EXPECT_EQ("/somewhere/here", outputDirectory(p, c));
  p.out = "/absolute";
  EXPECT_EQ("/absolute", outputDirectory(p, c));
  p.out = "";
  const std::string standard = outputDirectory(p, c);
  EXPECT_EQ(0u, standard.find("/somewhere/flights/climb-20")) << standard;
}

}  // namespace
}  // namespace monarch_flight
