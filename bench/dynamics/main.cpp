// The flight dynamics against conservation laws, exact motions, published histories and an
// independent engine (docs/dynamics.md).
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "dynamics/rows.h"
#include "monarch_flight/math/errors.h"

namespace monarch_flight::verify {
namespace {

using nlohmann::ordered_json;

const std::vector<DynamicsCheck>& checks() {
  static const std::vector<DynamicsCheck> all = {
      {"reduced", checkReducedForm}, {"exact", checkExactMotions}, {"momentum", checkConservation},
      {"energy", checkEnergy},       {"newmark", checkNewmark},    {"published", checkPublished},
#ifdef MONARCH_SIMBODY
      {"simbody", checkSimbody},
#endif
  };
  return all;
}

void requireKnown(const std::vector<std::string>& wanted) {
  std::string names;
  for (const DynamicsCheck& check : checks()) names += " " + check.name;
  for (const std::string& name : wanted) {
    const auto same = [&](const DynamicsCheck& check) { return check.name == name; };
    if (std::none_of(checks().begin(), checks().end(), same)) {
      throw InputError("unknown check \"" + name + "\": must be one of" + names);
    }
  }
}

void print(const DynamicsRow& row) {
  const char* verdict = row.stated() ? "stated" : row.pass() ? "pass" : "FAIL";
  std::printf("%-6s %-10s %9.2e", verdict, row.name.c_str(), row.error);
  if (row.stated()) {
    std::printf("%10s", "");
  } else {
    std::printf(" <= %6.0e", row.bound);
  }
  std::printf("  %s; %s\n", row.quantity.c_str(), row.resolution.c_str());
  std::fflush(stdout);
}

ordered_json json(const DynamicsRow& row) {
  return {{"case", "dynamics/" + row.name},
          {"quantity", row.quantity},
          {"resolution", row.resolution},
          {"computed", row.computed},
          {"reference", row.reference},
          {"error", row.error},
          {"bound", row.stated() ? ordered_json() : ordered_json(row.bound)},
          {"pass", row.pass()}};
}

/// The rows of verification.json, without those that the new ones replace.
ordered_json othersThan(const ordered_json& rows, const std::string& path) {
  ordered_json kept = ordered_json::array();
  std::ifstream in(path);
  if (!in) return kept;
  for (const auto& old : ordered_json::parse(in)) {
    const auto same = [&](const ordered_json& row) { return row.at("case") == old.at("case"); };
    if (std::none_of(rows.begin(), rows.end(), same)) kept.push_back(old);
  }
  return kept;
}

int run(int argc, char** argv) {
  DynamicsFolders folders{CONFIG_DIR, TEST_DATA_DIR, "verification"};
  std::vector<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("out:=", 0) == 0) {
      folders.out = argument.substr(5);
    } else {
      wanted.push_back(argument);
    }
  }
  requireKnown(wanted);
  std::filesystem::create_directories(folders.out);
  ordered_json rows = ordered_json::array();
  int failed = 0;
  for (const DynamicsCheck& check : checks()) {
    const bool take =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), check.name) != wanted.end();
    if (!take) continue;
    for (const DynamicsRow& row : check.run(folders)) {
      print(row);
      failed += !row.pass();
      rows.push_back(json(row));
    }
  }
  const std::string path = folders.out + "/verification.json";
  ordered_json all = othersThan(rows, path);
  for (const auto& row : rows) all.push_back(row);
  std::ofstream out(path);
  out << all.dump(1) << '\n';
  if (!out.flush()) throw InputError("cannot write " + path + "; choose another out:=DIR");
  std::printf("%zu rows, %d outside their bound; %s\n", rows.size(), failed, path.c_str());
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace monarch_flight::verify

int main(int argc, char** argv) {
  try {
    return monarch_flight::verify::run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "verify_dynamics: %s\n", e.what());
    return 2;
  }
}
