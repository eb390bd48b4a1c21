#include <ceres_ed/report/html/escape.h>

#include <string>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr char kReplacement[] = "\xEF\xBF\xBD";

TEST(EscapeHtml, LeavesNoCharacterThatMarkupHas) {
  EXPECT_EQ(EscapeHtml("<b a=\"1\" c='2'>&amp;"),
            "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;");
}

TEST(EscapeHtml, KeepsWordsOfAllLanguages) {
  const std::string text =
      "H\xC3\xBC"
      "fte \xE5\xBF\x83 \xF0\x9F\xAB\x80\tok\n";
  EXPECT_EQ(EscapeHtml(text), text);
}

TEST(EscapeHtml, ReplacesControlCharacters) {
  EXPECT_EQ(EscapeHtml(std::string("a\0"
                                   "b\x1b[31m\x7f",
                                   9)),
            std::string("a") + kReplacement + "b" + kReplacement + "[31m" + kReplacement);
  // The control characters beyond ASCII, and a line separator.
  EXPECT_EQ(EscapeHtml("\xC2\x85\xE2\x80\xA8"), std::string(kReplacement) + kReplacement);
}

TEST(EscapeHtml, ReplacesWhatTurnsTheDirectionOfWriting) {
  EXPECT_EQ(EscapeHtml("\xE2\x80\xAEylp.exe"), std::string(kReplacement) + "ylp.exe");
}

TEST(EscapeHtml, ReplacesBytesThatAreNotUtf8) {
  // A byte of Latin-1, a cut character, an overlong '<' and half of a surrogate pair.
  EXPECT_EQ(EscapeHtml("\xFC"), kReplacement);
  EXPECT_EQ(EscapeHtml("\xE5\xBF"), std::string(kReplacement) + kReplacement);
  EXPECT_EQ(EscapeHtml("\xC0\xBC"), std::string(kReplacement) + kReplacement);
  EXPECT_EQ(EscapeHtml("\xED\xA0\x80"), std::string(kReplacement) + kReplacement + kReplacement);
}

TEST(JsonForScript, NothingInItEndsTheElement) {
  const nlohmann::ordered_json value = {{"</script><script>alert(1)</script>", "<!--<script>&]]>"}};
  const std::string json = JsonForScript(value);
  EXPECT_EQ(json.find_first_of("<>&"), std::string::npos) << json;
  EXPECT_EQ(nlohmann::ordered_json::parse(json), value);
}

TEST(JsonForScript, IsAsciiWithoutControlCharacters) {
  std::string all;
  for (int c = 1; c < 128; ++c) all += static_cast<char>(c);
  const nlohmann::ordered_json value = {{"text", all + "\xE2\x80\xA8\xE2\x80\xA9\xC3\xBC"}};
  const std::string json = JsonForScript(value);
  for (const char c : json) {
    EXPECT_GE(c, ' ');
    EXPECT_LE(c, '~');
  }
  EXPECT_EQ(nlohmann::ordered_json::parse(json), value);
}

TEST(JsonForScript, BytesThatAreNotUtf8BecomeReplacements) {
  EXPECT_EQ(JsonForScript("a\xFF"), "\"a\\ufffd\"");
}

}  // namespace
}  // namespace ceres_ed
