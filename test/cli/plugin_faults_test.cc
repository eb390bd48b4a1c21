// What is wrong with an energy of a plugin ends a program with a sentence, and nothing else.
#include <ceres_ed/io/cloud_io.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/ed_slam_test_util.h>
#include <test/cli/run_program.h>

namespace ceres_ed {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

struct Fault {
  const char* energy;
  int exit_code;
  // What the line on stderr says after the plugin's name.
  const char* says;
};

constexpr Fault kFaults[] = {
    {"fails", 3, "residual 0 \\(node .*\\) says that it can't be evaluated"},
    {"throws", 3, "residual 0 \\(node .*\\) threw: no coffee"},
    {"nan", 3, "residual 0 \\(node .*\\) is not finite"},
    {"nan_derivative", 3, "residual 0 \\(node .*\\) has a derivative that is not finite"},
    {"nan_once_moved", 3, "residual [0-9]+ \\(node .*\\) is not finite"},
    {"odd_node", 3, "residual 1 is on node 1000000, which isn't there \\(.*\\)"},
    {"throws_adding", 3, "after 1 residuals it threw: no milk"},
    {"throws_making", 2, "no sugar"}};

// Last line of stderr.
std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

void ExpectSentence(const ProgramResult& result, const Fault& fault) {
  EXPECT_EQ(result.exit_code, fault.exit_code) << result.err;
  EXPECT_THAT(LastLine(result.err),
              MatchesRegex(std::string(".*energy '") + fault.energy + "' of plugin '" +
                           CERES_ED_FAULTY_PLUGIN + "': " + fault.says + ".*"));
}

class PluginFaults : public EdSlamTest, public ::testing::WithParamInterface<Fault> {};

TEST_P(PluginFaults, EndEdFitWithASentence) {
  const std::string pair = std::string(CERES_ED_SOURCE_DIR) + "/data/plane_bumps/";
  for (const char* solver : {"block", "ceres"}) {
    // Ceres says nothing of the steps that it could not evaluate.
    if (std::string(GetParam().energy) == "nan_once_moved" && std::string(solver) == "ceres")
      continue;
    const ProgramResult result =
        RunProgramFile(AppPath("ed_fit"),
                       {pair + "source.ply",
                        pair + "target.ply",
                        "--output=" + (dir_ / "out.ply"),
                        std::string("--linear_solver=") + solver,
                        std::string("--plugin=") + CERES_ED_FAULTY_PLUGIN,
                        std::string("--energy=") + GetParam().energy + ":weight=1e6"});
    ExpectSentence(result, GetParam());
    EXPECT_FALSE(Exists("out.ply"));
  }
}

TEST_P(PluginFaults, EndEdSlamWithASentence) {
  const std::string energy = GetParam().energy;
  WriteBumpySequence(Sequence(), 3);
  const ProgramResult result = Run(
      "out",
      {std::string("--plugin=") + CERES_ED_FAULTY_PLUGIN, "--energy=" + energy + ":weight=1e6"});
  ExpectSentence(result, GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, PluginFaults, ::testing::ValuesIn(kFaults), [](const auto& info) {
  return std::string(info.param.energy);
});

using Plugins = EdSlamTest;

TEST_F(Plugins, ThatThrowWhileTheyRegisterAreNamed) {
  const ProgramResult result = RunProgramFile(
      AppPath("ed_list_energies"), {std::string("--plugin=") + CERES_ED_THROWING_PLUGIN});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr(CERES_ED_THROWING_PLUGIN),
                    HasSubstr("registering its energies threw: cannot find its table")));
}

TEST_F(Plugins, MayBeSeveral) {
  const ProgramResult result = RunProgramFile(
      AppPath("ed_list_energies"),
      {std::string("--plugin=") + CERES_ED_FAULTY_PLUGIN + ";" + CERES_ED_GOOD_PLUGIN});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("anchor (prior)"), HasSubstr("nan_once_moved (prior)")));
}

TEST_F(Plugins, AndEnergiesThatDoNothingAreToldOf) {
  const std::string pair = std::string(CERES_ED_SOURCE_DIR) + "/data/plane_bumps/";
  const ProgramResult result = RunProgramFile(AppPath("ed_fit"),
                                              {pair + "source.ply",
                                               pair + "target.ply",
                                               "--output=" + (dir_ / "out.ply"),
                                               std::string("--plugin=") + CERES_ED_GOOD_PLUGIN,
                                               "--energy=pose_prior"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("energy 'pose_prior' has found nothing to add a residual to"),
                    HasSubstr("was loaded, and none of its energies is used")));
}

}  // namespace
}  // namespace ceres_ed
