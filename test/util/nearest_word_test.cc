#include <ceres_ed/util/nearest_word.h>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(EditDistance, CountsLettersPutInLeftOutChangedAndSwapped) {
  EXPECT_EQ(EditDistance("rings", "rings"), 0);
  EXPECT_EQ(EditDistance("rings", "ring"), 1);
  EXPECT_EQ(EditDistance("rings", "brings"), 1);
  EXPECT_EQ(EditDistance("rings", "rungs"), 1);
  EXPECT_EQ(EditDistance("rings", "rigns"), 1);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
}

TEST(NearestWord, IsTheOneThatWasMeant) {
  const std::vector<std::string> words = {"mode", "output", "rings", "report"};
  EXPECT_EQ(NearestWord("outptu", words), "output");
  EXPECT_EQ(NearestWord("ring", words), "rings");
  EXPECT_EQ(NearestWord("mdoe", words), "mode");
}

TEST(NearestWord, IsNothingWhereNoWordIsNear) {
  EXPECT_EQ(NearestWord("camera", {"mode", "output"}), "");
  EXPECT_EQ(NearestWord("ab", {"xy"}), "");
  EXPECT_EQ(NearestWord("mode", {}), "");
}

}  // namespace
}  // namespace ceres_ed
