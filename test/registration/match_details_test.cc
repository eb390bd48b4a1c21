// Tests the details of both sides that matching returns for a pair.
#include <ceres_ed/registration/matching.h>

#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

double Brightness(const Eigen::Vector3d& point) {
  return 0.5 + 0.02 * point.x() - 0.03 * point.y();
}

// Returns a flat grid of (side x side) points, one unit apart, facing +z. Its brightness is that of
// Brightness() at an offset `look` from each point.
PointCloud MakeSheet(int side, const Eigen::Vector3d& origin, const Eigen::Vector3d& look) {
  PointCloud sheet;
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) sheet.points.push_back(origin + Eigen::Vector3d(c, r, 0.0));
  }
  for (int r = 0; r + 1 < side; ++r) {
    for (int c = 0; c + 1 < side; ++c) {
      const int a = r * side + c;
      sheet.triangles.push_back({a, a + 1, a + side});
      sheet.triangles.push_back({a + 1, a + side + 1, a + side});
    }
  }
  for (const Eigen::Vector3d& p : sheet.points) sheet.intensities.push_back(Brightness(p + look));
  return sheet;
}

std::vector<int> All(const PointCloud& cloud) {
  std::vector<int> indices(cloud.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

class MatchDetails : public ::testing::Test {
 protected:
  MatchDetails() {
    options_.with_details = true;
    options_.reject_borders = false;
    for (const Eigen::Vector3d& point : source_.cloud().points) points_.push_back(turn_ * point);
    for (const Eigen::Vector3d& normal : source_.cloud().normals) {
      normals_.push_back(turn_ * normal);
    }
  }

  // Matches the source rotated by `turn_`.
  Matches Match(const Surface& target) const {
    const std::vector<int> all = All(source_.cloud());
    return MatchBothWays(
        {&source_, &all, &points_, &normals_}, target, All(target.cloud()), options_);
  }

  const Eigen::Vector3d look_{0.5, 0.25, 0.0};
  const Surface source_{MakeSheet(4, {2.5, 2.5, 0.2}, look_)};
  const Surface target_{MakeSheet(9, {0.0, 0.0, 0.0}, Eigen::Vector3d::Zero())};
  const Eigen::Quaterniond turn_{Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX())};
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;
  MatchingOptions options_;
};

TEST_F(MatchDetails, HoldTheWarpedNormalOfTheSourceAndThatOfTheTarget) {
  const Matches matches = Match(target_);
  ASSERT_GT(matches.inliers, 16);
  ASSERT_EQ(matches.details.size(), matches.correspondences.size());
  for (const Correspondence& c : matches.correspondences) {
    const MatchDetail& detail = matches.details.at(c.detail);
    EXPECT_LT((detail.source_normal - turn_ * Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_LT((detail.target_normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  }
}

TEST_F(MatchDetails, HoldTheBrightnessOfBothSidesAndItsGradient) {
  PointCloud bare = target_.cloud();
  bare.triangles.clear();
  const Surface bare_target(bare);
  for (const Surface* target : {&target_, &bare_target}) {
    const Matches matches = Match(*target);
    ASSERT_GT(matches.inliers, 16);
    for (const Correspondence& c : matches.correspondences) {
      const MatchDetail& detail = matches.details.at(c.detail);
      EXPECT_TRUE(detail.HasIntensities());
      EXPECT_NEAR(
          detail.source_intensity, Brightness(source_.cloud().points[c.point] + look_), 1e-12);
      EXPECT_NEAR(detail.target_intensity, Brightness(c.target), 1e-12);
      EXPECT_LT((detail.intensity_gradient - Eigen::Vector3d(0.02, -0.03, 0.0)).norm(), 1e-12);
    }
  }
}

TEST_F(MatchDetails, LeaveUnknownWhatACloudDoesNotHave) {
  PointCloud colorless = target_.cloud();
  colorless.intensities.clear();
  const Matches matches = Match(Surface(colorless));
  ASSERT_GT(matches.inliers, 16);
  for (const Correspondence& c : matches.correspondences) {
    const MatchDetail& detail = matches.details.at(c.detail);
    EXPECT_FALSE(detail.HasIntensities());
    EXPECT_TRUE(std::isfinite(detail.source_intensity));
    EXPECT_TRUE(detail.intensity_gradient.isZero(0.0));
  }
}

TEST_F(MatchDetails, ChangeNoPairAndAreLeftOutUnlessAskedFor) {
  const Matches with = Match(target_);
  options_.with_details = false;
  const Matches without = Match(target_);
  EXPECT_TRUE(without.details.empty());
  ASSERT_EQ(with.correspondences.size(), without.correspondences.size());
  for (std::size_t i = 0; i < with.correspondences.size(); ++i) {
    EXPECT_EQ(without.correspondences[i].detail, -1);
    EXPECT_EQ(with.correspondences[i].target, without.correspondences[i].target);
    EXPECT_EQ(with.correspondences[i].normal, without.correspondences[i].normal);
    EXPECT_EQ(with.correspondences[i].weight, without.correspondences[i].weight);
  }
}

}  // namespace
}  // namespace ceres_ed
