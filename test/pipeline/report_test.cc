#include <ceres_ed/pipeline/report.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

std::string ReadAll(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Report, WritesNullForNanAndInfinity) {
  const std::string path = ::testing::TempDir() + "/report.json";
  nlohmann::ordered_json report;
  report["b"] = std::nan("");
  report["a"] = {std::numeric_limits<double>::infinity(), 1.5};
  ASSERT_TRUE(WriteReport(path, report).ok());
  const auto back = nlohmann::ordered_json::parse(ReadAll(path));
  EXPECT_TRUE(back["b"].is_null());
  EXPECT_TRUE(back["a"][0].is_null());
  EXPECT_EQ(back["a"][1], 1.5);
  EXPECT_EQ(back.begin().key(), "b");
}

TEST(Report, SurvivesAPathThatIsNoUtf8) {
  const std::string path = ::testing::TempDir() + "/latin1.json";
  ASSERT_TRUE(WriteReport(path, {{"path", "caf\xe9.ply"}}).ok());
  EXPECT_EQ(nlohmann::ordered_json::parse(ReadAll(path))["path"], "caf\xef\xbf\xbd.ply");
}

TEST(Report, NamesAPathThatCannotBeWritten) {
  EXPECT_THAT(WriteReport("/nowhere/r.json", {}).message(), HasSubstr("/nowhere/r.json"));
}

TEST(Report, GivesEachFlagAValueOfItsType) {
  const RunFlags flags = {{"quiet", "true", RunFlag::Type::kBool},
                          {"last", "-1", RunFlag::Type::kInteger},
                          {"seed", "18446744073709551615", RunFlag::Type::kInteger},
                          {"w_rot", "0.1", RunFlag::Type::kNumber},
                          {"mode", "batch", RunFlag::Type::kText}};
  EXPECT_EQ(FlagsReport(flags).dump(),
            R"({"quiet":true,"last":-1,"seed":18446744073709551615,"w_rot":0.1,"mode":"batch"})");
}

}  // namespace
}  // namespace ceres_ed
