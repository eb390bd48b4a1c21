#include <csignal>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <apps/support/command_line.h>
#include <apps/support/program.h>
#include <apps/support/progress_bar.h>
#include <gflags/gflags.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

DEFINE_double(test_number, 0.1, "a number");
DEFINE_int32(test_integer, 3, "an integer");
DEFINE_bool(test_switch, false, "a switch");
DEFINE_string(test_text, "", "a text");

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const ProgramInfo kInfo = {"prog", "IN [OUT]", "Does nothing.", "prog a", 1, 2};

StatusOr<CommandLine> Parse(std::vector<const char*> words) {
  words.insert(words.begin(), "prog");
  return ParseCommandLine(kInfo, static_cast<int>(words.size()), words.data());
}

std::string ParseError(const std::vector<const char*>& words) {
  const auto parsed = Parse(words);
  EXPECT_FALSE(parsed.ok());
  return parsed.status().message();
}

int RunWith(const std::function<Outcome(const std::vector<std::string>&)>& body) {
  std::string program = "prog";
  std::string argument = "in";
  char* argv[] = {program.data(), argument.data(), nullptr};
  // RunProgram may set glog up once a process only; the command line is what is tested apart.
  return RunProgram(kInfo, 2, argv, body);
}

TEST(CommandLine, TakesFlagsInEveryForm) {
  const gflags::FlagSaver saver;
  const auto parsed =
      Parse({"in", "--test_number=2.5", "-test_integer", "-7", "--test_switch", "--", "--out"});
  ASSERT_TRUE(parsed.ok()) << parsed.status().message();
  EXPECT_THAT(parsed->arguments, ElementsAre("in", "--out"));
  EXPECT_EQ(FLAGS_test_number, 2.5);
  EXPECT_EQ(FLAGS_test_integer, -7);
  EXPECT_TRUE(FLAGS_test_switch);
  ASSERT_TRUE(Parse({"in", "--notest_switch"}).ok());
  EXPECT_FALSE(FLAGS_test_switch);
}

TEST(CommandLine, NamesABadValue) {
  const gflags::FlagSaver saver;
  EXPECT_EQ(ParseError({"in", "--test_number=abc"}),
            "bad value --test_number=abc, expected number");
  EXPECT_EQ(ParseError({"in", "--test_number=nan"}),
            "bad value --test_number=nan, expected number");
  EXPECT_EQ(ParseError({"in", "--test_integer=1.5"}),
            "bad value --test_integer=1.5, expected integer");
  EXPECT_EQ(ParseError({"in", "--test_switch=maybe"}),
            "bad value --test_switch=maybe, expected true|false");
  EXPECT_EQ(ParseError({"in", "--test_number"}), "flag --test_number needs a value");
  EXPECT_EQ(FLAGS_test_number, 0.1);
  EXPECT_EQ(FLAGS_test_integer, 3);
}

TEST(CommandLine, CountsArguments) {
  EXPECT_EQ(ParseError({}), "0 arguments given, expected 1 to 2: prog IN [OUT]");
  EXPECT_EQ(ParseError({"a", "b", "c"}), "3 arguments given, expected 1 to 2: prog IN [OUT]");
}

TEST(CommandLine, HelpNeedsNoArguments) {
  const auto parsed = Parse({"--help"});
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(parsed->request, CommandLine::Request::kHelp);
}

TEST(CommandLine, ReadsAFlagFileAndNamesItsBadLine) {
  const gflags::FlagSaver saver;
  const std::string path = ::testing::TempDir() + "/flags.txt";
  std::ofstream(path) << "# comment\n\n--test_number=4\n  --test_text=two words\n";
  const std::string flag = "--flagfile=" + path;
  ASSERT_TRUE(Parse({"in", flag.c_str()}).ok());
  EXPECT_EQ(FLAGS_test_number, 4.0);
  EXPECT_EQ(FLAGS_test_text, "two words");
  std::ofstream(path) << "--test_number=4\n--nothing=1\n";
  EXPECT_THAT(ParseError({"in", flag.c_str()}), HasSubstr("flags.txt, line 2: unknown flag"));
  std::ofstream(path) << flag << "\n";
  EXPECT_THAT(ParseError({"in", flag.c_str()}), HasSubstr("in a circle"));
}

// Each runs in a process of its own, for glog is set up once a process.
using ProgramDeathTest = ::testing::Test;

TEST(ProgramDeathTest, TurnsAnExceptionIntoOneLine) {
  const auto throws = [](const auto&) -> Outcome { throw std::runtime_error("two\nlines"); };
  EXPECT_EXIT(std::exit(RunWith(throws)),
              ::testing::ExitedWithCode(3),
              "^prog: unexpected error: two lines\n$");
  const auto exhausts = [](const auto&) -> Outcome { throw std::bad_alloc(); };
  EXPECT_EXIT(
      std::exit(RunWith(exhausts)), ::testing::ExitedWithCode(3), "^prog: out of memory\n$");
}

TEST(ProgramDeathTest, ReportsABadInputInOneLine) {
  const auto fails = [](const auto& arguments) {
    return Outcome::BadInput(Status::Error(arguments[0] + ": no such file"));
  };
  EXPECT_EXIT(
      std::exit(RunWith(fails)), ::testing::ExitedWithCode(2), "^prog: in: no such file\n$");
}

TEST(ProgramDeathTest, FirstSignalAsksAndSecondKills) {
  const auto survives_one = [](const auto&) {
    InstallStopHandler();
    CHECK(!StopRequested());
    std::raise(SIGTERM);
    CHECK(StopRequested());
    return Outcome::StoppedEarly("stopped");
  };
  EXPECT_EXIT(std::exit(RunWith(survives_one)), ::testing::ExitedWithCode(4), "^prog: stopped\n$");
  const auto dies_of_two = [](const auto&) {
    InstallStopHandler();
    std::raise(SIGTERM);
    std::raise(SIGTERM);
    return Outcome::Done();
  };
  EXPECT_EXIT(std::exit(RunWith(dies_of_two)), ::testing::KilledBySignal(SIGTERM), "");
}

TEST(TimeLeft, IsWhatTheRestTakesAtTheSameSpeed) {
  EXPECT_EQ(TimeLeft(0.5, 10, 100), "");
  EXPECT_EQ(TimeLeft(5.0, 0, 100), "");
  EXPECT_EQ(TimeLeft(5.0, 100, 100), "");
  EXPECT_EQ(TimeLeft(10.0, 20, 100), "about 40 s left");
  EXPECT_EQ(TimeLeft(100.0, 10, 100), "about 15 min left");
}

}  // namespace
}  // namespace ceres_ed
