// A fit is never worse than the rigid placement.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/point_energy.h>
#include <ceres_ed/geometry/stray_points.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

struct AstrayFunctor {
  static constexpr int kNumResiduals = 1;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[2] - 5.0;
    return true;
  }
};

// Pulls all points five diagonals up, away from any target.
class AstrayEnergy : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    for (int i = 0; i < static_cast<int>(context.points->size()); ++i) {
      AddPointResidual(context, i, AstrayFunctor(), 1.0, sink);
    }
  }
};

StatusOr<FitResult> FitDolphin(double weight_astray) {
  constexpr SyntheticShape kShape = SyntheticShape::kDolphin;
  FitInput input;
  input.source = MakeSyntheticShape(kShape, 600, 1.0);
  input.target = DeformSyntheticShape(kShape, 1.0, 0.3, MakeSyntheticShape(kShape, 800, 1.0));
  EnergyRegistry registry = BuiltinEnergies();
  EnergyInfo info;
  info.name = "astray";
  info.summary = "all points go up and away";
  EXPECT_TRUE(registry
                  .Register(std::move(info),
                            [](const ParameterValues&) { return std::make_unique<AstrayEnergy>(); })
                  .ok());
  FitOptions options;
  EnergySpec astray;
  astray.name = "astray";
  astray.weight = weight_astray;
  options.extra_energies = {astray};
  return Fit(input, options, registry);
}

TEST(FitFallback, TakesTheRigidPlacementWhereTheDeformationLeadsAstray) {
  const StatusOr<FitResult> result = FitDolphin(1e6);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_TRUE(result->rigid_only);
  EXPECT_THAT(result->warnings, Contains(HasSubstr("the result is the rigid one")));
  const PointCloud source = MakeSyntheticShape(SyntheticShape::kDolphin, 600, 1.0);
  ASSERT_EQ(result->points.size(), source.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    EXPECT_LT((result->points[i] - result->rigid * source.points[i]).norm(), 1e-12);
  }
}

struct AlongFunctor {
  static constexpr int kNumResiduals = 1;
  double goal;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[0] - goal;
    return true;
  }
};

// Pulls each point a little along x, within a surface that looks the same there.
class AlongEnergy : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    for (int i = 0; i < static_cast<int>(context.points->size()); ++i) {
      const double goal = (*context.points)[i].x() + 0.01;
      AddPointResidual(context, i, AlongFunctor{goal}, 1.0, sink);
    }
  }
};

TEST(FitFallback, KeepsWhatAnEnergyOfTheUserFinds) {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kPlane, 600, 1.0);
  input.target = input.source;
  EnergyRegistry registry = BuiltinEnergies();
  EnergyInfo info;
  info.name = "along";
  info.summary = "all points move along x";
  ASSERT_TRUE(registry
                  .Register(std::move(info),
                            [](const ParameterValues&) { return std::make_unique<AlongEnergy>(); })
                  .ok());
  FitOptions options;
  EnergySpec along;
  along.name = "along";
  along.weight = 100.0;
  options.extra_energies = {along};
  const StatusOr<FitResult> result = Fit(input, options, registry);
  ASSERT_TRUE(result.ok()) << result.status().message();
  // The rigid placement explains the target perfectly, so the energy can only make it worse.
  EXPECT_FALSE(result->rigid_only);
}

TEST(FitFallback, DoesNotCountWhatNobodySees) {
  constexpr SyntheticShape kShape = SyntheticShape::kKidney;
  FitInput input;
  input.source = MakeSyntheticShape(kShape, 1500, 1.0);
  input.target = DeformSyntheticShape(kShape, 1.0, 0.15, MakeSyntheticShape(kShape, 3000, 1.0));
  // A tenth of the target is left.
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : input.target.points) heights.push_back(point.z());
  std::sort(heights.begin(), heights.end());
  std::vector<int> hidden;
  for (std::size_t p = 0; p < input.target.size(); ++p) {
    if (input.target.points[p].z() < heights[heights.size() * 9 / 10]) {
      hidden.push_back(static_cast<int>(p));
    }
  }
  RemovePoints(hidden, &input.target);
  const StatusOr<FitResult> result = Fit(input, FitOptions(), BuiltinEnergies());
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_FALSE(result->rigid_only);
}

TEST(FitFallback, KeepsADeformationThatExplainsMore) {
  const StatusOr<FitResult> result = FitDolphin(0.0);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_FALSE(result->rigid_only);
  EXPECT_THAT(result->warnings, Not(Contains(HasSubstr("rigid"))));
}

}  // namespace
}  // namespace ceres_ed
