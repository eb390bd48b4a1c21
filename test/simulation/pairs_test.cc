#include "ceres_ed/simulation/pairs.h"

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/io/cloud_io.h>

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

PointCloud LoadShipped(const std::string& pair, const std::string& file) {
  auto loaded = LoadCloud(CERES_ED_SOURCE_DIR "/data/" + pair + "/" + file);
  EXPECT_TRUE(loaded.ok()) << loaded.status().message();
  return loaded.ok() ? loaded->cloud : PointCloud();
}

void ExpectSameToFloat(const PointCloud& made, const PointCloud& shipped) {
  ASSERT_EQ(made.size(), shipped.size());
  EXPECT_EQ(made.triangles, shipped.triangles);
  for (std::size_t k = 0; k < made.size(); ++k) {
    // Half a step of a float below 1 is 3e-8.
    ASSERT_LT((made.points[k] - shipped.points[k]).cwiseAbs().maxCoeff(), 6.1e-8) << k;
  }
}

TEST(SyntheticPairs, TheShippedHeartIsWhatTheProgramMakes) {
  const SyntheticPair pair = MakeSyntheticPair("heart_partial");
  ExpectSameToFloat(pair.source, LoadShipped("heart_partial", "source.ply"));
  ExpectSameToFloat(pair.target, LoadShipped("heart_partial", "target.ply"));
  ExpectSameToFloat(pair.truth, LoadShipped("heart_partial", "gt.ply"));
}

TEST(SyntheticPairs, TheShippedTargetsLieOnTheShippedTruths) {
  for (const std::string& name : SyntheticPairNames()) {
    const PointCloud truth = LoadShipped(name, "gt.ply");
    const PointCloud target = LoadShipped(name, "target.ply");
    ASSERT_FALSE(truth.empty() || target.empty()) << name;
    const StatusOr<Evaluation> evaluation = Evaluate(truth, target);
    ASSERT_TRUE(evaluation.ok()) << evaluation.status().message();
    // Two meshes of the same surface differ by the sagitta of their edges, and by the noise.
    const double diagonal = evaluation->diagonal;
    EXPECT_LT(evaluation->backward.InPercentOf(diagonal).mean, 0.15) << name;
    EXPECT_LT(evaluation->backward.InPercentOf(diagonal).max, 0.8) << name;
    // Except for the corners of the plane, no target vertex is a vertex of the truth.
    int shared = 0;
    const KdTree tree(truth.points);
    for (const auto& point : target.points) shared += tree.Nearest(point).squared_distance == 0.0;
    EXPECT_LE(shared, (name == "plane_bumps" ? 4 : 0)) << name;
  }
}

TEST(SyntheticPairs, TheDolphinHasHandlesThatMoveAndATrunkThatDoesNot) {
  const SyntheticPair pair = MakeSyntheticPair("dolphin_bend");
  EXPECT_GE(pair.landmarks.size(), 12u);
  EXPECT_GE(pair.fixed.size(), 50u);
  for (const int k : pair.fixed) {
    EXPECT_LT((pair.truth.points[k] - pair.source.points[k]).norm(), 1e-9);
  }
  for (const auto& [k, position] : pair.landmarks) {
    EXPECT_EQ(position, pair.truth.points[k]);
    EXPECT_GT((position - pair.source.points[k]).norm(), 0.02);
  }
}

TEST(SyntheticPairs, APartialTargetCoversAThirdToAHalf) {
  const SyntheticPair pair = MakeSyntheticPair("kidney_partial");
  EXPECT_GT(pair.overlap, 0.3);
  EXPECT_LT(pair.overlap, 0.45);
  const double share = static_cast<double>(pair.visible.size()) / pair.source.size();
  EXPECT_NEAR(share, pair.overlap, 0.06);
}

}  // namespace
}  // namespace ceres_ed
