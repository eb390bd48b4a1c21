#include <ceres_ed/report/view/scalar_field.h>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

ScalarField FieldOf(std::vector<double> values, ColorScale scale = ColorScale::kMagnitude) {
  ScalarField field;
  field.values = std::move(values);
  field.scale = scale;
  return field;
}

TEST(FieldRange, AMagnitudeBeginsAtZeroAndEndsAtThe98thPercentile) {
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i) values.push_back(1.0 + i);
  const ScalarField field = FieldOf(values);
  const FieldRange range = RangeOfFields({&field});
  EXPECT_EQ(range.low, 0.0);
  EXPECT_EQ(range.high, 99.0);
  EXPECT_EQ(range.min, 1.0);
  EXPECT_EQ(range.max, 101.0);
}

TEST(FieldRange, ASignedFieldHasZeroInItsMiddle) {
  const ScalarField field = FieldOf({-3.0, 1.0}, ColorScale::kSigned);
  const FieldRange range = RangeOfFields({&field});
  EXPECT_EQ(range.low, -3.0);
  EXPECT_EQ(range.high, 3.0);
  EXPECT_EQ(range.PartOf(0.0), 0.5);
}

TEST(FieldRange, ValuesAsideDoNotSetTheColours) {
  ScalarField field = FieldOf({1.0, 2.0, 50.0, 90.0});
  field.aside = {0, 0, 1, 1};
  EXPECT_EQ(RangeOfFields({&field}).high, 2.0);
  EXPECT_EQ(RangeOfFields({&field}).max, 90.0);
  EXPECT_NE(AsideNote(field), "");
  field.aside = {1, 1, 1, 1};
  EXPECT_EQ(RangeOfFields({&field}).high, 90.0);
}

TEST(FieldRange, SeveralSurfacesHaveOne) {
  const ScalarField one = FieldOf({0.0, 1.0});
  const ScalarField other = FieldOf({0.0, 5.0});
  EXPECT_EQ(RangeOfFields({&one, &other}).high, 5.0);
}

TEST(FieldRange, TheUnknownDoesNotCount) {
  const ScalarField field = FieldOf({std::nan(""), 2.0, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(RangeOfFields({&field}).max, 2.0);
  const ScalarField nothing = FieldOf({std::nan("")});
  EXPECT_EQ(RangeOfFields({&nothing}).high, 0.0);
}

TEST(FieldRange, AFewValuesThatDifferFromZeroStillHaveColours) {
  std::vector<double> values(1000, 0.0);
  values[7] = 4.0;
  const ScalarField field = FieldOf(values);
  EXPECT_EQ(RangeOfFields({&field}).high, 4.0);
}

}  // namespace
}  // namespace ceres_ed
