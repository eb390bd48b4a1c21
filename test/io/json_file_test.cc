#include "ceres_ed/io/json_file.h"

#include "io_test_util.h"

#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/warp_io.h>

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string Nested(int depth, const std::string& begin, const std::string& end) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += begin;
  text += "1";
  for (int i = 0; i < depth; ++i) text += end;
  return text;
}

std::string ErrorOf(const std::string& text) {
  return ParseJson<nlohmann::json>("a.json", text).status().message();
}

TEST(JsonFile, ValuesMayLieSomeDeepInOneAnother) {
  EXPECT_EQ(ErrorOf(Nested(kDeepestValue, "[", "]")), "");
  EXPECT_EQ(ErrorOf(Nested(kDeepestValue + 1, "[", "]")),
            "a.json: byte 64: values lie more than 64 deep in one another, expected fewer lists "
            "and objects in each other");
  EXPECT_THAT(ErrorOf(Nested(kDeepestValue + 1, "{\"a\":", "}")), HasSubstr("64 deep"));
}

TEST(JsonFile, BracketsInTextsAndSideBySideAreNotDeep) {
  const std::string many(1000, '[');
  EXPECT_EQ(ErrorOf("[\"" + many + "\", \"\\\"" + many + "\", \"\\\\\"]"), "");
  std::string row = "[[]";
  for (int i = 0; i < 1000; ++i) row += ",[]";
  EXPECT_EQ(ErrorOf(row + "]"), "");
}

TEST(JsonFile, SaysWhereATextIsCutOff) {
  EXPECT_THAT(ErrorOf("[1, 2"), StartsWith("a.json: no JSON, or cut off: no valid value at byte "));
  EXPECT_EQ(ErrorOf("[1e999]"), "a.json: no JSON: a number is beyond the range of double");
}

// What works on a value calls itself for the values in it: without an end the stack would overflow.
TEST(JsonFile, EachReaderRefusesWhatIsAbsurdlyDeep) {
  constexpr int kDepth = 1000000;
  const TemporaryDirectory directory;
  const std::string path = directory / "deep.json";
  const std::string deep = Nested(kDepth, "[", "]");
  WriteBytes(path, "{\"format\": " + deep + "}");
  EXPECT_THAT(ReadWarp(path).status().message(), HasSubstr("deep.json: byte "));
  EXPECT_THAT(ReadJsonFile(path).status().message(), HasSubstr("deep.json: byte "));
  EXPECT_THAT(ReadCamcalCalibration(path).status().message(), HasSubstr("deep.json: byte "));
  WriteBytes(path, "[{\"id\": \"A\", \"coordinates\": [1, " + deep + ", 3]}]");
  EXPECT_THAT(ReadLandmarkFile(path).status().message(), HasSubstr("deep.json: byte "));
}

// Nine lines that stand for 10^9 values.
TEST(YamlFile, AliasesMayNotMakeItLargerThanItsText) {
  const TemporaryDirectory directory;
  std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + alias;
    for (int k = 1; k < 10; ++k) text += ", " + alias;
    text += "]\n";
  }
  WriteBytes(directory / "a.yaml", text);
  EXPECT_THAT(ReadYamlFile(directory / "a.yaml").status().message(),
              HasSubstr("its aliases stand for more values than it has bytes"));
  WriteBytes(directory / "b.yaml", "a: &a [1, 2]\nb: *a\n");
  const auto once = ReadYamlFile(directory / "b.yaml");
  ASSERT_TRUE(once.ok()) << once.status().message();
  EXPECT_EQ((*once)["b"], (nlohmann::json{1.0, 2.0}));
}

TEST(YamlFile, RefusesWhatIsAbsurdlyDeep) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.yaml", Nested(1000000, "[", "]"));
  EXPECT_THAT(ReadYamlFile(directory / "a.yaml").status().message(), HasSubstr("a.yaml: "));
}

}  // namespace
}  // namespace ceres_ed
