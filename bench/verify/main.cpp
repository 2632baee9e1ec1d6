// The flow solver against exact solutions, tables, experiments and itself (docs/verification.md).
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "verify/report.h"
#include "verify/subjects.h"

namespace monarch_flight::verify {
namespace {

constexpr Subject kSubjects[] = {
    {"direct_solve", true, directSolve},
    {"added_mass", true, addedMass},
    {"uniform_stream", true, uniformStream},
    {"affine", true, affine},
    {"taylor_green", true, taylorGreen},
    {"stokes", true, stokes},
    {"blasius", true, blasius},
    {"momentum_balance", true, momentumBalance},
    {"plate_re100", false, plateRe100},
    {"disc_drag", false, discDrag},
    {"pitching_rolling", false, pitchingRolling},
    {"revolving_wing", false, revolvingWing},
    {"rim", false, rim},
    {"stability", false, stability},
    {"monarch_flap", false, monarchFlap},
    {"outer", false, outerBoundary},
};

int run(int argc, char** argv) {
  std::vector<std::string> known;
  for (const Subject& s : kSubjects) known.push_back(s.name);
  const Request request(argc, argv, known);
  printHead();
  int failed = 0;
  for (const Subject& s : kSubjects) {
    if (!request.takes(s.name, s.quick)) continue;
    Report report(s.name);
    s.run(report);
    write(s.name, report, request.out);
    for (const Row& r : report.rows()) failed += !r.pass;
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
    std::fprintf(stderr, "verify: %s\n", e.what());
    return 2;
  }
}
