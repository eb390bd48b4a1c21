#include "ceres_ed/pipeline/fit/scale_setting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST(ScaleSetting, ReadsANumberUnitsAndAuto) {
  EXPECT_EQ(ParseScale("")->factor, 1.0);
  EXPECT_EQ(ParseScale("2.5")->factor, 2.5);
  EXPECT_DOUBLE_EQ(ParseScale("mm:m")->factor, 1e-3);
  EXPECT_DOUBLE_EQ(ParseScale("in:mm")->factor, 25.4);
  EXPECT_DOUBLE_EQ(ParseScale("m:um")->factor, 1e6);
  EXPECT_TRUE(ParseScale("auto")->is_automatic);
  for (const char* bad :
       {"0", "-1", "nan", "inf", "1e999", "mm", "mm:", ":m", "mm:km", "2x", "Auto"}) {
    const StatusOr<ScaleSetting> setting = ParseScale(bad);
    ASSERT_FALSE(setting.ok()) << bad;
    EXPECT_THAT(setting.status().message(),
                HasSubstr(std::string("--scale=") + bad + ", expected"));
  }
}

TEST(ScaleSetting, SnapsToRatiosOfUnitsWhereNear) {
  const struct {
    double source;
    double target;
    double factor;
    bool estimated;
  } cases[] = {{1.0, 1.1, 1.0, false},
               {1.0, 2.9, 1.0, false},
               {1.0, 9.0, 10.0, false},
               {1.0, 27.0, 25.4, false},
               {110.0, 1.0, 0.01, false},
               {900.0, 1.0, 1e-3, false},
               {1.0, 5.0, 5.0, true},
               {1.0, 300.0, 300.0, true}};
  for (const auto& c : cases) {
    FitOptions options;
    const std::string note = ApplyScale({true, 1.0}, c.source, c.target, &options);
    EXPECT_DOUBLE_EQ(options.rigid.initial_scale, c.factor) << c.target;
    EXPECT_EQ(options.rigid.with_scale, c.estimated) << c.target;
    EXPECT_EQ(note.empty(), c.factor == 1.0) << note;
  }
}

}  // namespace
}  // namespace ceres_ed
