// Token files: who makes them, who may use them, what becomes of those that are left behind.
#include "monarch_flight/ros_io/token_file.h"

#include <gtest/gtest.h>
#include <monarch_flight/Hello.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "monarch_flight/math/errors.h"
#include "ros/nodes_fixture.h"

namespace monarch_flight {
namespace {

/// The parameter token_file in a namespace of its own.
class TokenFiles : public testing::Test {
 protected:
  TokenFiles() { ros::param::set(names_.topic(kTokenFileKey), path_); }
  ~TokenFiles() override { ros::param::del("/tokens"); }
  void write(const std::string& text, mode_t mode = 0600) const {
    std::ofstream(path_) << text;
    chmod(path_.c_str(), mode);
  }
  void makeFolder() const { std::filesystem::create_directories(folder_ / "new/deep"); }
  std::string refusal() const {
    try {
      TokenFile file(names_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  const RunNames names_{"/tokens/monarch_flight"};
  TemporaryFolder folder_;
  const std::string path_ = folder_ / "new/deep/token";
  const StopFlag go_{false};
};

TEST_F(TokenFiles, AreNewForEveryRunAndGoWithIt) {
  std::string first;
  for (int run = 0; run < 2; ++run) {
    TokenFile file(names_);
    struct stat facts {};
    ASSERT_EQ(0, stat(path_.c_str(), &facts));
    EXPECT_EQ(0600u, facts.st_mode & 0777u);
    for (const char* made : {"new", "new/deep"}) {
      ASSERT_EQ(0, stat((folder_ / made).c_str(), &facts));
      EXPECT_EQ(0700u, facts.st_mode & 0777u) << made;
    }
    const std::string text = fileText(path_);
    EXPECT_EQ(0u, text.rfind("of one run: ", 0));
    EXPECT_EQ(77u, text.size());
    EXPECT_NE(first, text);
    first = text;
    Hello here, there;
    here.case_name = there.case_name = "a case";
    file.token().seal("/topic", here);
    tokenOfRun(names_, go_).seal("/topic", there);
    EXPECT_EQ(here.seal, there.seal);
    file.remove();
    EXPECT_FALSE(exists(path_));
  }
}

TEST_F(TokenFiles, OfAPersonAreUsedAndStay) {
  makeFolder();
  write("a secret of a person\n");
  Hello here, expected;
  TokenFile(names_).token().seal("/topic", here);
  Token("a secret of a person").seal("/topic", expected);
  EXPECT_EQ(expected.seal, here.seal);
  EXPECT_TRUE(exists(path_));
}

TEST_F(TokenFiles, ThatOthersCouldReadAreRefused) {
  makeFolder();
  write("a secret of a person\n", 0640);
  EXPECT_NE(std::string::npos, refusal().find("others can read or write it; chmod 600 it"));
  write("short", 0600);
  EXPECT_NE(std::string::npos, refusal().find("holds 5 characters; a token has at least 16"));
}

TEST_F(TokenFiles, ASecondOwnerIsRefused) {
  const TokenFile first(names_);
  const std::string text = fileText(path_);
  EXPECT_NE(std::string::npos, refusal().find(path_ + ": is the token of another run"));
  EXPECT_EQ(text, fileText(path_));
}

TEST_F(TokenFiles, OfManyThatBeginTogetherOneIsTheOwner) {
  std::atomic<int> owners{0}, refused{0}, left{8};
  std::vector<std::thread> all;
  for (int i = 8; i > 0; --i)
    all.emplace_back([&] {
      try {
        const TokenFile file(names_);
        ++owners;
        for (--left; left > 0;) ros::WallDuration(0.01).sleep();
      } catch (const InputError&) {
        ++refused;
        --left;
      }
    });
  for (std::thread& one : all) one.join();
  EXPECT_EQ(1, owners);
  EXPECT_EQ(7, refused);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "new/deep"));  // no temporary names either
}

TEST_F(TokenFiles, LeftByAKilledRunAreReplacedAndNobodyTakesThem) {
  const std::string left = "of one run: " + std::string(64, 'a') + "\n";
  makeFolder();
  write(left);
  StopFlag stop{false};
  std::atomic<bool> known{false};
  std::thread participant([&] {
    Hello here, there;
    const Token token = tokenOfRun(names_, stop);
    token.seal("/topic", there);
    Token(left.substr(0, left.size() - 1)).seal("/topic", here);
    EXPECT_NE(here.seal, there.seal);
    known = true;
  });
  ros::WallDuration(0.3).sleep();
  EXPECT_FALSE(known);
  {
    const TokenFile file(names_);
    EXPECT_NE(left, fileText(path_));
    participant.join();
  }
  EXPECT_FALSE(exists(path_));
}

TEST_F(TokenFiles, AreFoundFromTheFolderOfTheRun) {
  ros::param::set(names_.topic("directory"), folder_ / "new");
  ros::param::set(names_.topic(kTokenFileKey), "deep/token");
  const TokenFile file(names_);
  EXPECT_TRUE(exists(path_));
  EXPECT_FALSE(tokenOfRun(names_, go_).empty());
}

TEST_F(TokenFiles, AutoIsNone) {
  ros::param::set(names_.topic(kTokenFileKey), "auto");
  EXPECT_TRUE(TokenFile(names_).token().empty());
  EXPECT_TRUE(tokenOfRun(names_, go_).empty());
  EXPECT_FALSE(exists("auto"));
}

}  // namespace
}  // namespace monarch_flight
