#include <ceres_ed/util/named_values.h>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

enum class Colour { kRed, kBlue, kNameless };

constexpr std::array<NamedValue<Colour>, 2> NamesOf(Colour) {
  return {{{"red", Colour::kRed}, {"blue", Colour::kBlue}}};
}

TEST(NamedValues, AreFoundByNameAndByValue) {
  EXPECT_EQ(NameOf(Colour::kBlue), "blue");
  EXPECT_EQ(FindByName<Colour>("blue"), Colour::kBlue);
  EXPECT_EQ(FindByName<Colour>("red"), Colour::kRed);
}

TEST(NamedValues, HaveNoValueForAnotherName) {
  EXPECT_FALSE(FindByName<Colour>("Red").has_value());
  EXPECT_FALSE(FindByName<Colour>("").has_value());
}

TEST(NamedValues, AreListedInTheOrderOfTheTable) {
  EXPECT_EQ(ListNames<Colour>(" or "), "red or blue");
}

TEST(NamedValuesDeathTest, RefuseAValueWithoutAName) {
  EXPECT_DEATH(NameOf(Colour::kNameless), "no name for the value 2");
}

}  // namespace
}  // namespace ceres_ed
