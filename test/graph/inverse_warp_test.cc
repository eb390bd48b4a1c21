#include <ceres_ed/graph/inverse_warp.h>

#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>
#include <test/graph/warp_examples.h>

namespace ceres_ed {
namespace {

std::unique_ptr<const SpaceWarp> Create(const Warp& warp) {
  StatusOr<std::unique_ptr<const SpaceWarp>> created = SpaceWarp::Create(warp);
  EXPECT_TRUE(created.ok()) << created.status().message();
  return *std::move(created);
}

TEST(InverseWarp, IsThatOfASimilarity) {
  Similarity similarity;
  similarity.scale = 0.4;
  similarity.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Eigen::Vector3d(3, 1, -2).normalized()));
  similarity.translation = {30, 20, -10};
  const std::unique_ptr<const SpaceWarp> warp = Create(MakeSimilarityWarp(similarity));
  const InverseWarp inverse(*warp, 1e-12);
  for (const Eigen::Vector3d& x : RandomPoints(100, 3)) {
    const InversePoint found = inverse.Find(similarity * (8.0 * x));
    EXPECT_LT((found.point - 8.0 * x).norm(), 1e-11);
    EXPECT_FALSE(found.is_folded);
  }
}

TEST(InverseWarp, ReturnsFromEveryPointThatTheWarpReaches) {
  for (const double amount : {0.05, 0.15, 0.25}) {
    const std::unique_ptr<const SpaceWarp> warp = Create(MakeLatticeWarp(6, amount, amount));
    const InverseWarp inverse(*warp, 1e-9);
    double worst = 0.0;
    int others = 0;
    for (Eigen::Vector3d x : RandomPoints(2000, 3)) {
      x = 3.0 * x + Eigen::Vector3d::Constant(2.5);
      const InversePoint found = inverse.Find((*warp)(x));
      worst = std::max(worst, found.residual);
      if ((found.point - x).norm() > 1e-6) ++others;
    }
    EXPECT_LE(worst, 1e-9) << amount;
    // A strong warp folds here and there, and has other inverses.
    if (amount < 0.1) {
      EXPECT_EQ(others, 0) << amount;
    }
  }
}

// All of space is mapped to the half with z >= 0, as if it were folded like a sheet of paper.
Warp MakeFold() {
  Warp warp = MakeLatticeWarp(2, 0.0, 0.0);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    const Eigen::Vector3d& g = warp.graph.position(j);
    if (g.z() > 0.5) continue;
    MutableNodeAffine(warp.state.node(j)) = Eigen::Vector3d(1, 1, -1).asDiagonal();
    MutableNodeTranslation(warp.state.node(j)) = Eigen::Vector3d(0, 0, 1.0 - 2.0 * g.z());
  }
  return warp;
}

TEST(InverseWarp, SaysWhereTheWarpIsFoldedAndWhereItReachesNothing) {
  const std::unique_ptr<const SpaceWarp> warp = Create(MakeFold());
  const InverseWarp inverse(*warp, 1e-9);
  const InversePoint above = inverse.Find({0.5, 0.5, 1.5});
  EXPECT_LE(above.residual, 1e-9);
  // Of the two points that are moved there, the one that is not turned inside out.
  EXPECT_FALSE(above.is_folded);
  EXPECT_GT(above.point.z(), 0.5);
  EXPECT_GT(inverse.Find({0.5, 0.5, -3.0}).residual, 1.0);

  // A warp that is a reflection has inverses, but each is in a fold.
  Warp mirror = MakeLatticeWarp(2, 0.0, 0.0);
  for (int j = 0; j < mirror.graph.num_nodes(); ++j) {
    MutableNodeAffine(mirror.state.node(j)) = Eigen::Vector3d(1, 1, -1).asDiagonal();
    MutableNodeTranslation(mirror.state.node(j)) =
        Eigen::Vector3d(0, 0, -2.0 * mirror.graph.position(j).z());
  }
  const std::unique_ptr<const SpaceWarp> reflected = Create(mirror);
  const InversePoint found = InverseWarp(*reflected, 1e-9).Find({0.2, 0.3, -0.4});
  EXPECT_LE(found.residual, 1e-9);
  EXPECT_TRUE(found.is_folded);
}

TEST(InverseWarp, EndsWhereNumbersLeaveTheRangeOfDouble) {
  Warp warp = MakeLatticeWarp(2, 0.0, 0.0);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    MutableNodeAffine(warp.state.node(j)) *= j % 2 == 0 ? 1e-300 : 1e300;
  }
  const std::unique_ptr<const SpaceWarp> extreme = Create(warp);
  const InverseWarp inverse(*extreme, 1e-9);
  for (const Eigen::Vector3d& y : RandomPoints(50, 4, 1e10)) {
    EXPECT_FALSE(inverse.Find(y).residual < 0.0);
  }
  MutableNodeTranslation(warp.state.node(0)).setConstant(1e308);
  warp.target_from_source.scale = 1e10;
  EXPECT_FALSE(SpaceWarp::Create(warp).ok());
}

}  // namespace
}  // namespace ceres_ed
