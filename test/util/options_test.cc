#include <ceres_ed/util/options.h>

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNan = std::nan("");

enum class Colour { kRed, kBlue };

constexpr std::array<NamedValue<Colour>, 2> NamesOf(Colour) {
  return {{{"red", Colour::kRed}, {"blue", Colour::kBlue}}};
}

struct InnerOptions {
  double width = 2.0;
  int threads = 1;

  static const OptionTable<InnerOptions>& Rows() {
    using O = InnerOptions;
    static const OptionTable<O> rows({
        Row(&O::width, "width", "How wide it is.").In(Above(0)).Unit("metres"),
        Row(&O::threads, "threads", "The result does not depend on it.").In(AtLeast(1)),
    });
    return rows;
  }
};

struct OuterOptions {
  bool bold = true;
  int rings = 2;
  double limit = kInfinity;
  std::string name = "x";
  Colour colour = Colour::kBlue;
  InnerOptions inner;
  std::function<void()> callback;

  static const OptionTable<OuterOptions>& Rows() {
    using O = OuterOptions;
    static const OptionTable<O> rows({
        Row(&O::bold, "bold", "Whether it is bold."),
        Row(&O::rings, "rings", "The rings.").In(AtLeast(1)).Special(0, "none").Main(),
        Row(&O::limit, "limit", "The limit.")
            .In(AboveOrInfinite(0))
            .Special(0, kInfinity, "unlimited"),
        Row(&O::name, "name", "Its name.").File().Letter('n'),
        Row(&O::colour, "colour", "Its colour."),
        Nested(&O::inner, InnerOptions::Rows(), "inner_").Internal("inner_threads"),
        NotData(&O::callback),
    });
    return rows;
  }
};

std::string ErrorOf(const OuterOptions& options) {
  std::string error;
  const bool is_valid = OuterOptions::Rows().Check(options, &error);
  EXPECT_EQ(is_valid, error.empty());
  return error;
}

TEST(OptionRange, HoldsItsClosedEndsAndNotItsOpenOnes) {
  EXPECT_TRUE(AtLeast(1).Contains(1));
  EXPECT_FALSE(AtLeast(1).Contains(0.999));
  EXPECT_FALSE(Above(1).Contains(1));
  EXPECT_TRUE(Above(1).Contains(1.001));
  EXPECT_TRUE(Between(1, 8).Contains(1));
  EXPECT_TRUE(Between(1, 8).Contains(8));
  EXPECT_FALSE(Between(1, 8).Contains(9));
  EXPECT_FALSE(AboveUpTo(0, 180).Contains(0));
  EXPECT_TRUE(AboveUpTo(0, 180).Contains(180));
  EXPECT_FALSE(Inside(0, 1).Contains(0));
  EXPECT_FALSE(Inside(0, 1).Contains(1));
  EXPECT_TRUE(Inside(0, 1).Contains(0.5));
}

TEST(OptionRange, NeverHoldsNanAndInfinityOnlyWhereItSaysSo) {
  for (const OptionRange& range : {OptionRange(), AtLeast(0), Above(0), AboveOrInfinite(0)}) {
    EXPECT_FALSE(range.Contains(kNan));
    EXPECT_EQ(range.Contains(kInfinity), range.with_infinity);
    EXPECT_FALSE(range.Contains(-kInfinity) && range.lowest > -kInfinity);
  }
}

TEST(OptionRange, IsToldInWords) {
  EXPECT_EQ(AtLeast(0).Text(/*is_whole=*/true), "a whole number >= 0");
  EXPECT_EQ(Between(1, 8).Text(/*is_whole=*/true), "a whole number from 1 to 8");
  EXPECT_EQ(Above(0).Text(/*is_whole=*/false), "a finite number > 0");
  EXPECT_EQ(AboveOrInfinite(0).Text(/*is_whole=*/false), "a number > 0");
  EXPECT_EQ(AboveUpTo(0, 180).Text(/*is_whole=*/false), "a finite number in (0, 180]");
  EXPECT_EQ(Inside(0, 0.5).Text(/*is_whole=*/false), "a finite number in (0, 0.5)");
}

TEST(OptionTable, AcceptsDefaultsAndSpecialValues) {
  OuterOptions options;
  EXPECT_EQ(ErrorOf(options), "");
  options.rings = 0;
  options.limit = kInfinity;
  EXPECT_EQ(ErrorOf(options), "");
}

TEST(OptionTable, NamesTheOptionItsValueAndItsRange) {
  OuterOptions options;
  options.rings = -1;
  EXPECT_EQ(ErrorOf(options), "rings is -1, expected a whole number >= 1 (0 = none)");
  options = OuterOptions();
  options.limit = 0.0;
  EXPECT_EQ(ErrorOf(options), "limit is 0, expected a number > 0");
  options.limit = kNan;
  EXPECT_EQ(ErrorOf(options), "limit is nan, expected a number > 0");
}

TEST(OptionTable, ChecksNestedOptionsUnderTheirPrefix) {
  OuterOptions options;
  options.inner.width = kInfinity;
  EXPECT_EQ(ErrorOf(options), "inner_width is inf, expected a finite number > 0");
  options = OuterOptions();
  options.inner.threads = 0;
  EXPECT_EQ(ErrorOf(options), "inner_threads is 0, expected a whole number >= 1");
}

TEST(OptionTable, GivesTheMembersThemselves) {
  OuterOptions options;
  const auto* rings = OuterOptions::Rows().Find("rings");
  ASSERT_NE(rings, nullptr);
  *std::get<int*>(rings->field(&options)) = 7;
  EXPECT_EQ(options.rings, 7);
  const auto* width = OuterOptions::Rows().Find("inner_width");
  ASSERT_NE(width, nullptr);
  EXPECT_EQ(std::get<double*>(width->field(&options)), &options.inner.width);
  EXPECT_EQ(width->option.unit, "metres");
}

TEST(OptionTable, ReadsAndSetsEnumsByName) {
  OuterOptions options;
  const auto* row = OuterOptions::Rows().Find("colour");
  ASSERT_NE(row, nullptr);
  const OptionField field = row->field(&options);
  EXPECT_EQ(OptionText(field), "blue");
  EXPECT_EQ(ExpectedText(row->option, field), "red or blue");
  const auto& named = std::get<NamedField>(field);
  EXPECT_FALSE(named.set(named.value, "green"));
  EXPECT_EQ(options.colour, Colour::kBlue);
  EXPECT_TRUE(named.set(named.value, "red"));
  EXPECT_EQ(options.colour, Colour::kRed);
}

TEST(OptionTable, HidesInternalRowsFromFind) {
  EXPECT_EQ(OuterOptions::Rows().Find("inner_threads"), nullptr);
  EXPECT_EQ(OuterOptions::Rows().num_members(), 7);
}

TEST(OptionTableDeathTest, RefusesTwoOptionsOfOneName) {
  using O = InnerOptions;
  EXPECT_DEATH(OptionTable<O>({Row(&O::width, "a", "A."), Row(&O::threads, "a", "B.")}),
               "two options are named a");
}

TEST(OptionText, IsAsShortAsReadsBackTheSame) {
  double tenth = 0.1;
  EXPECT_EQ(OptionText(&tenth), "0.1");
  double infinite = kInfinity;
  EXPECT_EQ(OptionText(&infinite), "inf");
}

}  // namespace
}  // namespace ceres_ed
