#include "ceres_ed/util/shown_text.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(ShownText, HasNoControlCharacters) {
  EXPECT_EQ(ShownText("a\x1b[31mb\r\a\x7f"), "a?[31mb???");
  EXPECT_EQ(ShownText(std::string("a\0b", 3)), "a?b");
  // The same as one character of UTF-8: the control sequence introducer.
  EXPECT_EQ(ShownText("a\xc2\x9b"
                      "31m"),
            "a?31m");
}

TEST(ShownLine, IsOneLine) { EXPECT_EQ(ShownLine("one\ttwo\n\x1b[31m"), "one?two??[31m"); }

TEST(ShownText, KeepsLinesTabsAndLetters) {
  EXPECT_EQ(ShownText("one\ttwo\n"), "one\ttwo\n");
  EXPECT_EQ(ShownText("gr\xc3\xb6\xc3\x9f"
                      "er \xc2\xb5m"),
            "gr\xc3\xb6\xc3\x9f"
            "er \xc2\xb5m");
}

}  // namespace
}  // namespace ceres_ed
