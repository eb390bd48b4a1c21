#include <ceres_ed/pipeline/run_command.h>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

RunFlag Given(const std::string& name, const std::string& value) {
  RunFlag flag;
  flag.name = name;
  flag.value = value;
  flag.is_given = true;
  return flag;
}

TEST(CommandText, HasArgumentsAndTheFlagsThatWereGiven) {
  RunFlag unset = Given("threads", "1");
  unset.is_given = false;
  EXPECT_EQ(CommandText("ed_fit", {"a.ply", "", "b.ply"}, {Given("output", "c.ply"), unset}),
            "ed_fit a.ply b.ply --output=c.ply");
}

TEST(CommandText, QuotesWhatAShellWouldChange) {
  EXPECT_EQ(CommandText("ed_fit", {"my file", "$(rm -r .)", "it's"}, {}),
            "ed_fit 'my file' '$(rm -r .)' 'it'\\''s'");
  EXPECT_EQ(CommandText("ed_fit", {}, {Given("energy", "a:b=1;c")}), "ed_fit '--energy=a:b=1;c'");
}

TEST(GivenFlagsReport, NamesTheFlagsThatWereGiven) {
  EXPECT_EQ(GivenFlagsReport({Given("output", "c.ply"), RunFlag()}),
            nlohmann::ordered_json({"output"}));
}

}  // namespace
}  // namespace ceres_ed
