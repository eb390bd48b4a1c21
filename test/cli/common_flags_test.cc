// What every program promises, whatever it does.
#include <ceres_ed/linear_algebra/front_kernels.h>
#include <ceres_ed/version.h>

#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/run_program.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> AllApps() {
  std::vector<std::string> names;
  std::string rest = CERES_ED_APPS;
  for (std::size_t comma; (comma = rest.find(',')) != std::string::npos;) {
    names.push_back(rest.substr(0, comma));
    rest = rest.substr(comma + 1);
  }
  names.push_back(rest);
  return names;
}

class EveryProgram : public ::testing::TestWithParam<std::string> {
 protected:
  ProgramResult Run(const std::vector<std::string>& arguments) {
    return RunProgramFile(AppPath(GetParam()), arguments);
  }
};

TEST_P(EveryProgram, ShowsHelpOfOneScreen) {
  for (const char* flag : {"--help", "-help", "-h"}) {
    const ProgramResult result = Run({flag});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, StartsWith("Usage: " + GetParam() + " "));
    EXPECT_THAT(result.out, HasSubstr("\nExample: " + GetParam() + " "));
    const std::vector<std::string> lines = SplitLines(result.out);
    EXPECT_LE(lines.size(), 50u) << result.out;
    for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST_P(EveryProgram, ShowsAllFlagsInNoMoreThanAHundredColumns) {
  const ProgramResult result = Run({"--help=all"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith("Usage: " + GetParam() + " "));
  for (const std::string& line : SplitLines(result.out)) EXPECT_LE(line.size(), 100u) << line;
}

TEST_P(EveryProgram, SuggestsAFlagForAMisspeltOne) {
  const ProgramResult result = Run({"--hepl"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, GetParam() + ": unknown flag --hepl, did you mean --help? (see --help)\n");
}

TEST_P(EveryProgram, HidesTheFlagsOfTheLibraries) {
  const std::string help = Run({"--help=all"}).out;
  for (const char* flag : {"--flagfile", "--helpfull", "--logtostderr", "--minloglevel", "--v "}) {
    EXPECT_THAT(help, Not(HasSubstr(flag)));
  }
}

TEST_P(EveryProgram, ShowsItsVersion) {
  const ProgramResult result = Run({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = SplitLines(result.out);
  EXPECT_THAT(lines, Contains(std::string("ceres_ed ") + kVersion));
  EXPECT_THAT(lines, Contains(StartsWith("Ceres 2.")));
  EXPECT_THAT(lines, Contains(StartsWith("sparse library ")));
  EXPECT_THAT(lines, Contains(StartsWith("BLAS ")));
  EXPECT_THAT(lines, Contains(std::string("vector kernels ") + FrontKernelName()));
  EXPECT_THAT(lines, Contains("threads " + std::to_string(std::thread::hardware_concurrency())));
}

TEST_P(EveryProgram, RefusesAnUnknownFlagInOneLine) {
  for (const char* flag : {"--no_such_flag=1", "--no_such_flag", "-no_such_flag", "--helpfull"}) {
    const ProgramResult result = Run({flag});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    const std::vector<std::string> lines = SplitLines(result.err);
    ASSERT_EQ(lines.size(), 1u) << result.err;
    EXPECT_THAT(lines[0], StartsWith(GetParam() + ": unknown flag --"));
    EXPECT_THAT(lines[0], HasSubstr("see --help"));
  }
}

TEST_P(EveryProgram, RefusesTooManyArgumentsInOneLine) {
  // ed_report takes many.
  const ProgramResult result = Run(std::vector<std::string>(40, "a"));
  EXPECT_EQ(result.exit_code, 1);
  ASSERT_EQ(SplitLines(result.err).size(), 1u) << result.err;
  EXPECT_THAT(result.err, StartsWith(GetParam() + ": 40 arguments given, expected "));
}

INSTANTIATE_TEST_SUITE_P(Apps, EveryProgram, ::testing::ValuesIn(AllApps()), [](const auto& info) {
  return info.param;
});

}  // namespace
}  // namespace ceres_ed
