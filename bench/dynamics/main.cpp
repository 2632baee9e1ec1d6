// The flight dynamics against conservation laws, exact motions, published histories and an
// independent engine (docs/dynamics.md).
#include <cstdio>
#include <exception>
#include <filesystem>

#include "dynamics/rows.h"
#include "verify/report.h"

namespace monarch_flight::verify {
namespace {

const std::vector<DynamicsCheck>& checks() {
  static const std::vector<DynamicsCheck> all = {
      {"reduced", checkReducedForm}, {"exact", checkExactMotions}, {"momentum", checkConservation},
      {"energy", checkEnergy},       {"newmark", checkNewmark},    {"six_dof", checkSixDof},
      {"published", checkPublished},
#ifdef MONARCH_SIMBODY
      {"simbody", checkSimbody},
#endif
  };
  return all;
}

int run(int argc, char** argv) {
  std::vector<std::string> known;
  for (const DynamicsCheck& check : checks()) known.push_back(check.name);
  const Request request(argc, argv, known);
  const DynamicsFolders folders{CONFIG_DIR, TEST_DATA_DIR, request.out};
  std::filesystem::create_directories(folders.out);
  printHead();
  int failed = 0;
  for (const DynamicsCheck& check : checks()) {
    if (!request.takes(check.name)) continue;
    const std::string subject = "dynamics/" + check.name;
    Report report(subject);
    for (const DynamicsRow& r : check.run(folders)) {
      const std::string of = r.name == check.name ? "" : r.name + ": ";
      report.add(
          {"", of + r.quantity, r.resolution, r.computed, r.reference, r.error, r.bound, r.pass()});
      failed += !r.pass();
    }
    write(subject, report, request.out);
  }
  std::printf("%d outside their bound\n", failed);
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
