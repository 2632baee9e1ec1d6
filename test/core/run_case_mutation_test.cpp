// 2,000 broken case and parameter files: each is read, or refused with a message for a person; no
// crash, no hang, no other exception.
#include <chrono>
#include <cstdio>

#include "core/case_fixture.h"
#include "core/mutation.h"
#include "monarch_flight/run/federation.h"

namespace monarch_flight {
namespace {

constexpr int kFiles = 2000;
constexpr double kLongest = 5.0;  // of one reading [s]; a thousand times what it takes

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A shipped case and a file that it is made of.
struct Subject {
  const char* name;
  const char* file;
};

constexpr Subject kSubjects[] = {
    {"climb_printed", "cases/climb_printed.yaml"},
    {"climb_fwuav", "cases/climb_fwuav.yaml"},
    {"climb_trimmed", "cases/climb_trimmed.yaml"},
    {"hinge", "cases/hinge.yaml"},
    {"plate_re100", "cases/plate_re100.yaml"},
    {"tethered_fwuav", "cases/tethered_fwuav.yaml"},
    {"climb_printed", "insects/monarch_paper.yaml"},
    {"climb_printed", "insects/monarch_kinematics.yaml"},
    {"climb_printed", "insects/monarch_planform.csv"},
    {"climb_fwuav", "insects/monarch_fwuav.yaml"},
    {"hinge", "insects/whitney_wood_wing.csv"},
    {"climb_printed", "defaults.yaml"},
};

class MutationTest : public CaseTest {
 protected:
  void SetUp() override {
    CaseTest::SetUp();
    fs::copy(CONFIG_DIR, folder_, fs::copy_options::recursive);
  }
  void put(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  std::string faultsOf(const std::string& name) const {
    try {
      loadCase(name, {}, folder_.string());
    } catch (const InputError& e) {
      return e.what();
    }
    return "no fault";
  }
};

TEST_F(MutationTest, EveryBrokenFileIsReadOrRefusedWithAMessage) {
  Mutation mutation(20260214);
  int refused = 0;
  double longest = 0.0;
  for (int i = 0; i < kFiles; ++i) {
    const Subject& subject = kSubjects[mutation.pick(std::size(kSubjects))];
    const std::string whole = contentOf(fs::path(CONFIG_DIR) / subject.file);
    const std::string broken = mutation(whole);
    put(subject.file, broken);
    const auto begin = std::chrono::steady_clock::now();
    try {
      const Case c = loadCase(subject.name, {}, folder_.string());
      EXPECT_EQ(makeModel(c).problems(), std::vector<std::string>()) << subject.file << "\n"
                                                                     << broken;
    } catch (const InputError& e) {
      ++refused;
      EXPECT_GT(std::string(e.what()).size(), 10u) << subject.file << "\n" << broken;
    } catch (const std::exception& e) {
      ADD_FAILURE() << "mutation " << i << " of " << subject.file << ": " << e.what() << "\n"
                    << broken;
    }
    const double s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    longest = std::max(longest, s);
    EXPECT_LT(s, kLongest) << subject.file << "\n" << broken;
    put(subject.file, whole);
  }
  std::printf("%d files: %d refused, %d read; at most %.3f s\n", kFiles, refused, kFiles - refused,
              longest);
  EXPECT_GT(refused, kFiles / 5);  // the mutations do break something
  EXPECT_LT(refused, kFiles);
}

/// A number that is replaced by what is no number is refused by the name of its key.
TEST_F(MutationTest, AWrongValueIsNamedByItsKey) {
  const std::string whole = contentOf(fs::path(CONFIG_DIR) / "cases/climb_printed.yaml");
  int checked = 0;
  std::size_t begin = 0;
  while (begin < whole.size()) {
    const std::size_t end = std::min(whole.find('\n', begin), whole.size());
    const std::string line = whole.substr(begin, end - begin);
    const std::size_t colon = line.find(": ");
    if (line.find('#') == std::string::npos && colon != std::string::npos) {
      const std::size_t first = line.find_first_not_of(' ');
      const std::string key = line.substr(first, colon - first);
      if (key != "name" && key != "description") {
        std::string broken = whole;
        broken.replace(begin + colon + 2, line.size() - colon - 2, "{rubbish: [1, x]}");
        put("cases/climb_printed.yaml", broken);
        expectHas(faultsOf("climb_printed"), key);
        ++checked;
      }
    }
    begin = end + 1;
  }
  EXPECT_GT(checked, 20);
}

}  // namespace
}  // namespace monarch_flight
