// The flow solver against exact solutions, tables, experiments and itself (docs/verification.md).
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>

#include "monarch_flight/math/errors.h"
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
    {"rim", false, rim},
    {"stability", false, stability},
    {"monarch_flap", false, monarchFlap},
    {"outer", false, outerBoundary},
};

std::string names() {
  std::string all;
  for (const Subject& s : kSubjects) all += std::string(" ") + s.name + (s.quick ? "" : "*");
  return all;
}

std::vector<const Subject*> chosen(const std::vector<std::string>& wanted) {
  std::vector<const Subject*> list;
  for (const Subject& s : kSubjects) {
    bool take = wanted.empty() && s.quick;
    for (const std::string& name : wanted) take = take || name == "all" || name == s.name;
    if (take) list.push_back(&s);
  }
  for (const std::string& name : wanted) {
    bool known = name == "all";
    for (const Subject& s : kSubjects) known = known || name == s.name;
    if (!known)
      throw InputError("unknown subject \"" + name + "\": must be all or one of" + names());
  }
  return list;
}

int run(int argc, char** argv) {
  std::string out = "verification";
  std::vector<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "out:=", 5) == 0) {
      out = argv[i] + 5;
    } else {
      wanted.push_back(argv[i]);
    }
  }
  const auto subjects = chosen(wanted);
  std::filesystem::create_directories(out);
  std::printf("%-16s %-34s %-26s %12s %12s %10s %10s\n", "case", "quantity", "resolution",
              "computed", "reference", "error", "bound");
  int failed = 0;
  for (const Subject* s : subjects) {
    Report report(s->name);
    s->run(report);
    write(s->name, report, out);
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
