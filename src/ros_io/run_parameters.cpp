#include "monarch_flight/ros_io/run_parameters.h"

#include <XmlRpcValue.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <stdexcept>

#include "monarch_flight/fluid/processes.h"
#include "monarch_flight/math/errors.h"
#include "monarch_flight/ros_io/token_file.h"
#include "monarch_flight/run/plan.h"
#include "monarch_flight/run/run_keys.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;
using Values = std::map<std::string, std::string>;
using Faults = std::vector<std::string>;

constexpr char kNotGiven[] = "auto";  // of launch files, whose optional arguments need a default

/// Who takes the keys: a command line (`where` is empty), or the parameter server.
std::string taker(const std::string& where) { return where.empty() ? "program" : "server"; }

std::string known(const std::string& where) {
  std::string names;
  for (const RunKey& key : runKeys(configDirectory())) {
    if (key.takenBy(taker(where))) names += (names.empty() ? "" : ", ") + key.name;
  }
  return names;
}

// The shortest text that reads back as the same number: nodes and command line then agree bit for
// bit.
std::string shortest(double value) {
  char text[40];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

// A key with an allowed value into its place.
void assign(const RunKey& key, const std::string& value, RunParameters& out) {
  const std::map<std::string, std::string*> texts = {{"case", &out.name},
                                                     {"out", &out.out},
                                                     {"resume", &out.resume},
                                                     {"directory", &out.directory}};
  const auto text = texts.find(key.name);
  if (!key.override.empty()) {
    out.overrides[key.name] = value;
  } else if (text != texts.end()) {
    *text->second = value;
  } else if (key.name == "plan") {
    out.plan = value == "true";
  } else if (key.name == "paused") {
    out.paused = value == "true";
  } else if (key.name == "rviz") {
    out.rviz = value == "true";
  } else if (key.name == "rate") {
    out.rate = std::strtod(value.c_str(), nullptr);
  } else if (key.name == "watchdog") {
    out.watchdog_s = std::strtod(value.c_str(), nullptr);
  } else if (key.name == "threads") {
    out.threads = static_cast<int>(std::strtod(value.c_str(), nullptr));
  } else if (key.name == "ranks") {
    out.ranks = static_cast<int>(std::strtod(value.c_str(), nullptr));
  } else if (key.name != "frame_prefix" && key.name != kTokenFileKey) {  // RunNames, TokenFile
    throw std::logic_error("config/keys.yaml: " + key.name + " has no place in RunParameters");
  }
}

void take(const std::string& name, const std::string& value, const std::string& where,
          RunParameters& out, Faults& faults) {
  const RunKey* key = findKey(runKeys(configDirectory()), name);
  if (key == nullptr || !key->takenBy(taker(where))) {
    faults.push_back(where + name + ": unknown parameter; known are " + known(where));
    return;
  }
  // Overrides are checked with the case.
  const std::string allowed = key->override.empty() ? key->fault(value) : "";
  if (allowed.empty()) {
    assign(*key, value, out);
  } else {
    faults.push_back(where + name + " = " + value + ": must be " + allowed);
  }
}

RunParameters checked(const Values& values, const std::string& where, Faults faults) {
  RunParameters out;
  const auto given = [&where](const std::string& value) {
    return !value.empty() && (value != kNotGiven || where.empty());
  };
  for (const auto& [key, value] : values) {
    if (given(value)) take(key, value, where, out, faults);
  }
  if (!out.resume.empty() && !out.out.empty()) {
    faults.push_back(where + "out = " + out.out + ": a resumed run goes on in its own folder (" +
                     where + "resume = " + out.resume + "); leave one of them out");
  }
  if (!out.resume.empty() && (values.count("case") == 0 || !given(values.at("case"))))
    out.name = out.resume + "/case.yaml";
  if (!faults.empty()) throw InputError(faults);
  return out;
}

std::string text(XmlRpc::XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpc::XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return shortest(static_cast<double>(value));
    default:
      return value.getType() == XmlRpc::XmlRpcValue::TypeString ? static_cast<std::string>(value)
                                                                : std::string();
  }
}

}  // namespace

RunParameters runParameters(const Values& values, const std::string& where) {
  return checked(values, where, {});
}

RunParameters runParameters(int argc, char** argv) {
  Values values;
  Faults faults;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t mark = argument.find(":=");
    if (argument.rfind("__", 0) == 0) continue;
    if (mark == std::string::npos || mark == 0) {
      faults.push_back("'" + argument + "': must be key:=value; known keys are " + known(""));
    } else if (mark + 2 == argument.size() && argument != "directory:=") {
      faults.push_back("'" + argument + "': has no value; give one or leave the key out");
    } else if (!values.emplace(argument.substr(0, mark), argument.substr(mark + 2)).second) {
      faults.push_back("'" + argument + "': this key is given twice; give it once");
    }
  }
  return checked(values, "", faults);
}

RunParameters runParameters(XmlRpc::XmlRpcValue& parameters, const std::string& where) {
  Values values;
  Faults faults;
  if (parameters.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    for (auto& entry : parameters) {
      const auto type = entry.second.getType();
      if (type == XmlRpc::XmlRpcValue::TypeStruct) continue;  // private parameters of a node
      const bool scalar =
          type == XmlRpc::XmlRpcValue::TypeBoolean || type == XmlRpc::XmlRpcValue::TypeInt ||
          type == XmlRpc::XmlRpcValue::TypeDouble || type == XmlRpc::XmlRpcValue::TypeString;
      if (scalar) {
        values[entry.first] = text(entry.second);
      } else {
        faults.push_back(where + entry.first + ": must be a number, a text, true or false");
      }
    }
  }
  return checked(values, where, faults);
}

Case loadCase(const RunParameters& parameters) {
  std::string name = parameters.name;
  const bool path = name.find('/') != std::string::npos || name.find(".yaml") != std::string::npos;
  if (path && !parameters.directory.empty()) name = fs::path(parameters.directory) / name;
  CaseOverrides overrides = parameters.overrides;
  const auto file = overrides.find("guidance_file");
  if (file != overrides.end() && !parameters.directory.empty())
    file->second = (fs::path(parameters.directory) / file->second).lexically_normal();
  Case c = loadCase(name, overrides, configDirectory());
  if (parameters.watchdog_s > 0.0) c.watchdog_s = parameters.watchdog_s;
  return c;
}

void requireProcesses(const RunParameters& parameters, const Case& c) {
  const std::string ranks = "ranks = " + std::to_string(parameters.ranks) + ": ";
  if (parameters.ranks > 1 && c.fluid != FluidKind::kNavierStokes) {
    throw InputError(ranks + fluidName(c) + " runs on one process; use ranks:=1");
  }
  if (parameters.ranks != flowProcesses()) {
    throw InputError(ranks + "the fluid was started on " + std::to_string(flowProcesses()) +
                     " process(es); start it by mpirun -np " + std::to_string(parameters.ranks) +
                     ", as scripts/fly and the launch files do");
  }
}

std::string plannedRun(const RunParameters& parameters, const Case& c, bool nodes) {
  if (c.fluid != FluidKind::kNavierStokes) return "";
  // Not yet started on as many processes: a plan, for one machine.
  const int here = parameters.ranks == flowProcesses() ? flowProcessesHere() : parameters.ranks;
  const RunPlan plan = planRun(c, parameters.ranks, here);
  requirePossible(plan);
  if (nodes || parameters.ranks > 1) requireInTime(plan, c.watchdog_s);
  return describe(plan);
}

std::string outputDirectory(const RunParameters& parameters, const Case& c) {
  const fs::path base =
      parameters.directory.empty() ? fs::current_path() : fs::path(parameters.directory);
  if (!parameters.resume.empty()) return fs::absolute(base / parameters.resume).lexically_normal();
  if (!parameters.out.empty()) return fs::absolute(base / parameters.out).lexically_normal();
  const std::time_t now = std::time(nullptr);
  char stamp[32];
  std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", std::localtime(&now));
  return fs::absolute(base / "flights" / (c.name + "-" + stamp)).lexically_normal();
}

}  // namespace monarch_flight
