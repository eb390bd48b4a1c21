// Every member of every Options struct has a row, so that IsValid() checks all of them.
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/simulation/sequences.h>
#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/solver/solver_types.h>
#include <ceres_ed/util/options.h>

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <test/util/option_members.h>

namespace ceres_ed {
namespace {

template <typename Options>
class EveryOptions : public ::testing::Test {};

using AllOptions = ::testing::Types<BindingOptions,
                                    FeatureOptions,
                                    FinishOptions,
                                    FitOptions,
                                    FitSchedule,
                                    FitWeights,
                                    GraphOptions,
                                    LazyOptions,
                                    LevelsOptions,
                                    MapGrowthOptions,
                                    MatchingOptions,
                                    ObservedSurfaceOptions,
                                    PixelTrackerOptions,
                                    RigidOptions,
                                    SequenceOptions,
                                    SlamOptions,
                                    SolverOptions,
                                    StrategyOptions,
                                    SyntheticSequenceOptions,
                                    TissueMemoryOptions>;
TYPED_TEST_SUITE(EveryOptions, AllOptions);

TYPED_TEST(EveryOptions, HasAnEntryForEachMember) {
  EXPECT_EQ(TypeParam::Rows().num_members(), CountMembers<TypeParam>());
}

TYPED_TEST(EveryOptions, HasDefaultsInRange) {
  std::string error;
  EXPECT_TRUE(TypeParam::Rows().Check(TypeParam(), &error)) << error;
}

// A row refuses a value that it does not permit, whatever the values of the others are.
TYPED_TEST(EveryOptions, RefusesNanAndWhatIsBeyondABound) {
  for (const auto& row : TypeParam::Rows()) {
    TypeParam options;
    std::string error;
    const OptionField field = row.field(&options);
    if (auto* const* real = std::get_if<double*>(&field)) {
      **real = std::nan("");
      EXPECT_FALSE(TypeParam::Rows().Check(options, &error)) << row.option.name;
      **real = -std::numeric_limits<double>::infinity();
      EXPECT_FALSE(TypeParam::Rows().Check(options, &error)) << row.option.name;
      **real = std::numeric_limits<double>::infinity();
      EXPECT_EQ(TypeParam::Rows().Check(options, &error), row.option.range.with_infinity)
          << row.option.name;
    } else if (auto* const* whole = std::get_if<int*>(&field)) {
      **whole = std::numeric_limits<int>::min();
      EXPECT_FALSE(TypeParam::Rows().Check(options, &error)) << row.option.name;
    }
  }
}

TYPED_TEST(EveryOptions, SaysWhatEachIsInASentence) {
  for (const auto& row : TypeParam::Rows()) {
    ASSERT_FALSE(row.option.doc.empty()) << row.option.name;
    EXPECT_EQ(row.option.doc.back(), '.') << row.option.name;
  }
}

}  // namespace
}  // namespace ceres_ed
