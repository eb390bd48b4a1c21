#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/util/options.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <apps/support/command_line.h>
#include <apps/support/option_flags.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Colour { kRed, kBlue };

constexpr std::array<NamedValue<Colour>, 2> NamesOf(Colour) {
  return {{{"red", Colour::kRed}, {"blue", Colour::kBlue}}};
}

struct Settings {
  std::string target;
  bool quick = false;
  bool corners = true;
  int count = 2;
  int workers = 1;
  std::uint64_t seed = 7;
  double limit = kInfinity;
  double share = 0.1;
  Colour colour = Colour::kBlue;
  int hidden = 3;
  FitOptions fit;
};

const OptionTable<Settings>& SettingsRows() {
  using S = Settings;
  static const OptionTable<S> rows({
      Row(&S::target, "target", "File to write.").Letter('t').File(),
      Row(&S::quick, "quick", "Be quick.").Main(),
      Row(&S::corners, "corners", "Whether corners are followed.").Words("auto", "none").Main(),
      Row(&S::count, "count", "How many.").In(Between(1, 5)).Main(),
      Row(&S::workers, "workers", "How many work.").In(AtLeast(1)).Special(0, 12, "auto"),
      Row(&S::seed, "seed", "The seed."),
      Row(&S::limit, "limit", "The limit.")
          .In(AboveOrInfinite(0))
          .Unit("metres")
          .Special(0, kInfinity, "unlimited"),
      Row(&S::share, "share", "The share.").In(Inside(0, 1)),
      Row(&S::colour, "colour", "The colour."),
      Row(&S::hidden, "hidden", "Set by the library.").Group(OptionGroup::kInternal),
      Nested(&S::fit, FitOptions::Rows(), "fit_"),
  });
  return rows;
}

const OptionFlags<Settings> kFlags(SettingsRows());
const ProgramInfo kInfo = {"prog", "[IN]", "Does nothing.", "prog a", 0, 1};

Status Parse(std::vector<const char*> words) {
  words.insert(words.begin(), "prog");
  return ParseCommandLine(kInfo, static_cast<int>(words.size()), words.data()).status();
}

StatusOr<Settings> ReadWith(const std::vector<const char*>& words) {
  const gflags::FlagSaver saver;
  const Status parsed = Parse(words);
  if (!parsed.ok()) return parsed;
  return kFlags.Read();
}

std::string ErrorOf(const std::vector<const char*>& words) {
  return ReadWith(words).status().message();
}

TEST(OptionFlags, HaveTheDefaultsOfTheMembers) {
  StatusOr<Settings> read = ReadWith({});
  ASSERT_TRUE(read.ok()) << read.status().message();
  Settings defaults;
  for (const auto& row : SettingsRows()) {
    EXPECT_EQ(OptionText(row.field(&*read)), OptionText(row.field(&defaults))) << row.option.name;
  }
}

TEST(OptionFlags, SetTheMembers) {
  const StatusOr<Settings> read = ReadWith({"-t",
                                            "out",
                                            "--quick",
                                            "--corners=none",
                                            "--count=5",
                                            "--seed=18446744073709551615",
                                            "--limit=2.5",
                                            "--colour=red",
                                            "--fit_rings=4",
                                            "--fit_rigid_scale"});
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->target, "out");
  EXPECT_TRUE(read->quick);
  EXPECT_FALSE(read->corners);
  EXPECT_EQ(read->count, 5);
  EXPECT_EQ(read->seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(read->limit, 2.5);
  EXPECT_EQ(read->colour, Colour::kRed);
  EXPECT_EQ(read->fit.strategy.rings, 4);
  EXPECT_TRUE(read->fit.rigid.with_scale);
}

TEST(OptionFlags, TakeSpecialValuesByNumberAndByWord) {
  for (const char* flag : {"--workers=0", "--workers=auto"}) {
    const StatusOr<Settings> read = ReadWith({flag});
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->workers, 12);
  }
  for (const char* flag : {"--limit=0", "--limit=unlimited"}) {
    const StatusOr<Settings> read = ReadWith({flag});
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->limit, kInfinity);
  }
}

TEST(OptionFlags, RefuseWhatIsOutOfRange) {
  EXPECT_EQ(ErrorOf({"--count=0"}), "--count=0, expected a whole number from 1 to 5");
  EXPECT_EQ(ErrorOf({"--count=6"}), "--count=6, expected a whole number from 1 to 5");
  EXPECT_EQ(ErrorOf({"--workers=-1"}), "--workers=-1, expected a whole number >= 1 (0 = auto)");
  EXPECT_EQ(ErrorOf({"--limit=-1"}), "--limit=-1, expected a number > 0 (0 = unlimited)");
  EXPECT_EQ(ErrorOf({"--share=0"}), "--share=0, expected a finite number in (0, 1)");
  EXPECT_EQ(ErrorOf({"--share=inf"}), "--share=inf, expected a finite number in (0, 1)");
  EXPECT_EQ(ErrorOf({"--share=nan"}), "bad value --share=nan, expected number");
  EXPECT_EQ(ErrorOf({"--colour=green"}), "--colour=green, expected red or blue");
  EXPECT_EQ(ErrorOf({"--corners=some"}), "--corners=some, expected auto or none");
  EXPECT_EQ(ErrorOf({"--count=auto"}), "bad value --count=auto, expected integer");
}

TEST(OptionFlags, SuggestTheNearestFlagForAMisspeltOne) {
  EXPECT_EQ(ErrorOf({"--taregt=x"}), "unknown flag --taregt, did you mean --target?");
  EXPECT_EQ(ErrorOf({"--colur=red"}), "unknown flag --colur, did you mean --colour?");
  EXPECT_EQ(ErrorOf({"--hlep"}), "unknown flag --hlep, did you mean --help?");
  EXPECT_EQ(ErrorOf({"--xyzzy"}), "unknown flag --xyzzy");
  EXPECT_EQ(ErrorOf({"--hidden=1"}), "unknown flag --hidden");
}

TEST(OptionFlags, AreShownInGroupsWithUnitsAndDefaults) {
  const std::string all = FullHelp(kInfo);
  const std::size_t files = all.find("\nFiles ");
  const std::size_t main = all.find("\nWhat matters ");
  const std::size_t expert = all.find("\nFor experts ");
  ASSERT_NE(expert, std::string::npos) << all;
  const auto group_of = [&](const std::string& flag) {
    const std::size_t place = all.find("\n  --" + flag);
    EXPECT_NE(place, std::string::npos) << flag;
    return place > expert ? expert : place > main ? main : files;
  };
  EXPECT_EQ(group_of("target, -t "), files);
  EXPECT_EQ(group_of("count "), main);
  EXPECT_EQ(group_of("share "), expert);
  EXPECT_THAT(all, HasSubstr("The limit. 0 = unlimited. [0 metres]"));
  EXPECT_THAT(all, HasSubstr("The colour. One of red, blue. [blue]"));
  EXPECT_THAT(all, Not(HasSubstr("--hidden")));
}

TEST(OptionFlags, ForExpertsAreLeftOutOfTheShortHelp) {
  const std::string text = ShortHelp(kInfo);
  EXPECT_THAT(text, HasSubstr("\n  --target, -t "));
  EXPECT_THAT(text, HasSubstr("\n  --count "));
  EXPECT_THAT(text, Not(HasSubstr("--share")));
  EXPECT_THAT(text, HasSubstr("\n--help=all shows "));
}

TEST(OptionFlags, AreTheRowsOfATable) {
  const std::string table = MarkdownHelp(kInfo);
  EXPECT_THAT(table,
              HasSubstr("| `--limit` | metres | a number > 0 (0 = unlimited) | 0 | The "
                        "limit. |\n"));
  EXPECT_THAT(table, HasSubstr("| `--colour` | - | red, blue | blue | The colour. |\n"));
}

TEST(CommandLine, TakesTheFormatOfHelp) {
  const auto help_of = [](const char* word) -> std::string {
    const char* words[] = {"prog", word};
    const auto parsed = ParseCommandLine(kInfo, 2, words);
    if (!parsed.ok() || parsed->request != CommandLine::Request::kHelp) return "";
    return parsed->help->text(kInfo);
  };
  EXPECT_EQ(help_of("--help"), ShortHelp(kInfo));
  EXPECT_EQ(help_of("-h"), ShortHelp(kInfo));
  EXPECT_EQ(help_of("--help=all"), FullHelp(kInfo));
  EXPECT_EQ(help_of("--help=man"), ManPage(kInfo));
  EXPECT_EQ(Parse({"--help=most"}).message(), "--help=most, expected all");
}

}  // namespace
}  // namespace ceres_ed
