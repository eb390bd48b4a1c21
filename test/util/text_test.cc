#include "ceres_ed/util/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Trim, TakesBlanksFromBothEnds) {
  EXPECT_EQ(Trim(" \ta b\r"), "a b");
  EXPECT_EQ(Trim(" \t"), "");
  EXPECT_EQ(Trim(""), "");
}

TEST(SplitFields, HasOneFieldMoreThanThereAreSeparators) {
  EXPECT_THAT(SplitFields("a,, b,", ','), ElementsAre("a", "", " b", ""));
  EXPECT_THAT(SplitFields("", ','), ElementsAre(""));
}

TEST(SplitLines, HasNoLineBehindTheLastSeparator) {
  EXPECT_THAT(SplitLines("a;;b;", ';'), ElementsAre("a", "", "b"));
  EXPECT_THAT(SplitLines("a", ';'), ElementsAre("a"));
  EXPECT_THAT(SplitLines(";", ';'), ElementsAre(""));
  EXPECT_THAT(SplitLines("", ';'), IsEmpty());
}

TEST(SplitWords, HasNoEmptyWords) {
  EXPECT_THAT(SplitWords(", a,b\t c ", ", \t"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(SplitWords(" ,", ", \t"), IsEmpty());
}

}  // namespace
}  // namespace ceres_ed
