// A run's folder that is in use, and a disk that is too small or refuses.
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "run_files_fixture.h"

namespace monarch_flight {
namespace {

template <class Action>
std::string messageOf(Action action) {
  try {
    action();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

// The system refuses to let any file grow beyond this many bytes while an object of this class
// lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_;
  sighandler_t handler_;
};

TEST_F(RunFiles, ExistingFlightIsNotOverwritten) {
  fs::create_directories(out());
  std::ofstream(out() + "/flight.csv") << "an earlier flight\n";
  EXPECT_THROW(RunOutputs(smallCase(), out()), InputError);
  const std::string message = messageOf([&] { RunDirectory(out(), 0); });
  EXPECT_NE(message.find(out()), std::string::npos);
  EXPECT_NE(message.find("empty folder"), std::string::npos);
  EXPECT_EQ(read("flight.csv"), "an earlier flight\n");
  EXPECT_FALSE(exists("case.yaml"));
  fs::remove(out() + "/flight.csv");
  EXPECT_NO_THROW(RunDirectory(out(), 0));  // an empty folder is welcome
}

TEST_F(RunFiles, FileInPlaceOfAFolderIsRefused) {
  std::ofstream(out()) << "text";
  EXPECT_NE(messageOf([&] { RunDirectory(out(), 0); }).find("must be a folder"), std::string::npos);
  EXPECT_NE(messageOf([&] { RunDirectory(out() + "/below", 0); }).find("cannot be created"),
            std::string::npos);
}

TEST_F(RunFiles, TooSmallADiskIsRefusedBeforehand) {
  const std::string message = messageOf([&] { RunDirectory(out(), std::uint64_t{1} << 62); });
  EXPECT_NE(message.find("MB left"), std::string::npos);
  EXPECT_NE(message.find("free space"), std::string::npos);
  EXPECT_THROW(RunDirectory(out(), std::uint64_t{1} << 62), InputError);
}

TEST(EstimatedOutput, GrowsWithStepsAndWithTheBag) {
  Case c = smallCase();
  c.output.checkpoint_every = 0;  // their size does not depend on the steps
  const auto small = estimatedOutputBytes(c);
  c.output.record = true;
  const auto recorded = estimatedOutputBytes(c);
  c.time.steps *= 10;
  EXPECT_GT(recorded, small);
  EXPECT_GT(estimatedOutputBytes(c), 5 * recorded / 2);
}

TEST_F(RunFiles, RefusedWriteEndsTheRunAndLeavesTheTableUnderItsActiveName) {
  RunOutputs outputs(smallCase(), out());
  outputs.onStep(stepAt(0));
  std::string failure;
  {
    const FileSizeLimit limit(3000);
    for (std::uint32_t n = 1; n <= 25 && failure.empty(); ++n) {
      CommittedStep step = stepAt(n);
      step.iterations.resize(1);  // flight.csv is the first file to reach the limit
      failure = messageOf([&] { outputs.onStep(step); });
    }
  }
  EXPECT_NE(failure.find("flight.csv.active cannot be written"), std::string::npos) << failure;
  EXPECT_NE(failure.find("out:="), std::string::npos);
  const std::string end = messageOf([&] { outputs.onEnd(failure); });
  EXPECT_TRUE(end.empty()) << "the failure is known already: " << end;
  EXPECT_TRUE(exists("flight.csv.active"));
  EXPECT_FALSE(exists("flight.csv"));
  EXPECT_TRUE(exists("iterations.csv"));
  const auto j = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(j.at("status"), "failed");
  EXPECT_EQ(j.at("failure"), failure);
}

TEST_F(RunFiles, RefusedSummaryIsAFailureOfItsOwn) {
  RunOutputs outputs(smallCase(), out());
  outputs.onStep(stepAt(0));
  std::string end;
  {
    const FileSizeLimit limit(100);
    end = messageOf([&] { outputs.onEnd(""); });
  }
  EXPECT_NE(end.find("summary.json.active cannot be written"), std::string::npos) << end;
  EXPECT_FALSE(exists("summary.json"));
  EXPECT_TRUE(exists("flight.csv"));
}

TEST(OutputFileTest, FullDeviceIsNamedWithReasonAndRemedy) {
  const std::string folder =
      fs::temp_directory_path() / ("monarch_full_" + std::to_string(getpid()));
  fs::create_directories(folder);
  fs::create_symlink("/dev/full", folder + "/table.active");
  std::string message;
  {
    OutputFile file(folder + "/table");
    message = messageOf([&] { file.write("x"); });
    EXPECT_TRUE(file.failed());
    EXPECT_EQ(messageOf([&] { file.finish(); }), message);
  }
  fs::remove_all(folder);
  EXPECT_NE(message.find("table.active cannot be written (No space left on device): free space"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace monarch_flight
