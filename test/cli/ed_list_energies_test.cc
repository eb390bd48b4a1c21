#include <ceres_ed/energy/energy_registry.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/run_program.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

TEST(EdListEnergies, NamesEveryBuiltinEnergyAndItsParameters) {
  const ProgramResult result = RunProgramFile(AppPath("ed_list_energies"), {});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = SplitLines(result.out);
  const EnergyRegistry registry = BuiltinEnergies();
  ASSERT_FALSE(registry.List().empty());
  for (const EnergyInfo* energy : registry.List()) {
    EXPECT_THAT(lines, Contains(StartsWith(energy->name + " (")));
    for (const EnergyParameter& parameter : energy->parameters) {
      EXPECT_THAT(lines, Contains(StartsWith("  " + parameter.name + ": ")));
    }
  }
}

TEST(EdListEnergies, RefusesAPluginThatIsNotThere) {
  const ProgramResult result =
      RunProgramFile(AppPath("ed_list_energies"), {"--plugin=/nowhere/plugin.so"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "ed_list_energies: plugin '/nowhere/plugin.so': cannot be read: No such file or "
            "directory\n");
}

TEST(EdListEnergies, WritesMarkdownToo) {
  const ProgramResult result = RunProgramFile(AppPath("ed_list_energies"), {"--format=markdown"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(SplitLines(result.out),
              IsSupersetOf({"### `rotation`",
                            "Prior: each node's affine matrix stays near a rotation.",
                            "| `rotation_sigma` | number | degree | 1e-09 to 360 | 1 | spread of "
                            "rotation |"}));
  EXPECT_EQ(RunProgramFile(AppPath("ed_list_energies"), {"--format=xml"}).exit_code, 1);
}

}  // namespace
}  // namespace ceres_ed
