// The manual page and the completion of a program, made from rows like those of the programs.
#include <ceres_ed/util/options.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <apps/support/help/help.h>
#include <apps/support/option_flags.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

enum class Colour { kRed, kBlue };

constexpr std::array<NamedValue<Colour>, 2> NamesOf(Colour) {
  return {{{"red", Colour::kRed}, {"blue", Colour::kBlue}}};
}

struct Settings {
  std::string target;
  std::string cover;
  bool quick = false;
  double limit = 1.5;
  int workers = 1;
  Colour colour = Colour::kBlue;
};

const OptionTable<Settings>& SettingsRows() {
  using S = Settings;
  static const OptionTable<S> rows({
      Row(&S::target, "target", "File to write; C:\\x is a path.").Letter('t').File(),
      Row(&S::cover, "cover", "File to write.").Alone("inside").File(),
      Row(&S::quick, "quick", "Be quick.").Letter('q').Main(),
      Row(&S::limit, "limit", "The limit.").Unit("mm").Main(),
      Row(&S::workers, "workers", "How many work.").Special(0, 12, "auto"),
      Row(&S::colour, "colour", "The colour."),
  });
  return rows;
}

const OptionFlags<Settings> kFlags(SettingsRows());

const ProgramInfo kInfo = {
    "prog", "IN OUT", "Makes OUT of IN. '.x' is a name.", "prog in out --quick", 2, 2};

// Returns the words that bash offers for the last one of `words`, one in each line and sorted.
std::string Offered(const std::string& words) {
  // Tests that run side by side must not share these files.
  const std::string base = ::testing::TempDir() + "/completion_of_" +
                           ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string script = base + ".bash";
  const std::string result = base + ".txt";
  std::ofstream(script) << BashCompletion(kInfo) << "compopt() { :; }\n"
                        << "COMP_WORDS=(prog " << words << ")\n"
                        << "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                        << "_prog\nprintf '%s\\n' \"${COMPREPLY[@]}\" | LC_ALL=C sort\n";
  const std::string command = "bash '" + script + "' > '" + result + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
  std::stringstream text;
  text << std::ifstream(result).rdbuf();
  return text.str();
}

TEST(ManPage, HasEveryFlagWithUnitAndDefault) {
  const std::string page = ManPage(kInfo);
  EXPECT_THAT(page, HasSubstr(".TH PROG 1 "));
  EXPECT_THAT(page, HasSubstr("prog \\- makes OUT of IN\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-t, \\-\\-target\\fR\\fI=text\\fR\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-limit\\fR\\fI=number\\fR\nThe limit. [1.5 mm]\n"));
  EXPECT_THAT(page, HasSubstr("The colour. One of red, blue. [blue]\n"));
  EXPECT_THAT(page, HasSubstr("prog in out \\-\\-quick\n"));
}

TEST(ManPage, HidesWhatRoffWouldTakeForItsOwn) {
  const std::string page = ManPage(kInfo);
  EXPECT_THAT(page, HasSubstr("C:\\ex is a path"));
  const ProgramInfo dotted = {"prog", "IN", ".x is a name.", "prog in", 1, 1};
  EXPECT_THAT(ManPage(dotted), HasSubstr("\n\\&.x is a name.\n"));
}

TEST(BashCompletion, OffersFlags) {
  EXPECT_EQ(Offered("--c"), "--colour=\n--cover\n");
  EXPECT_EQ(Offered("--qu"), "--quick\n");
  EXPECT_EQ(Offered("--quick --li"), "--limit=\n");
}

TEST(BashCompletion, OffersTheNamesOfAValueBehindEqualsOrABlank) {
  EXPECT_EQ(Offered("--colour = r"), "red\n");
  EXPECT_EQ(Offered("--colour ="), "blue\nred\n");
  EXPECT_EQ(Offered("--colour b"), "blue\n");
  EXPECT_EQ(Offered("--workers = a"), "auto\n");
  EXPECT_EQ(Offered("--quick = f"), "false\n");
  EXPECT_EQ(Offered("-q = t"), "true\n");
}

TEST(BashCompletion, LeavesFilesToBash) {
  EXPECT_EQ(Offered("--target = x"), "\n");
  EXPECT_EQ(Offered("in"), "\n");
  EXPECT_EQ(Offered("--cover in"), "\n");
}

TEST(FindHelpFormat, KnowsNoOtherName) {
  EXPECT_NE(FindHelpFormat("man"), nullptr);
  EXPECT_EQ(FindHelpFormat("html"), nullptr);
}

}  // namespace
}  // namespace ceres_ed
