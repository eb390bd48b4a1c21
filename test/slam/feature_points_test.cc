#include "ceres_ed/slam/frame/feature_points.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>
#include <test/slam/map_edits.h>
#include <test/slam/picture_scenes.h>

namespace ceres_ed {
namespace {

// One pixel is 0.05 at z = 6.
constexpr double kDepth = 6.0;
constexpr double kPixel = kDepth / 120.0;

ObservedSurface Sheet() {
  return {RenderDepth(SmallCamera(), TiltedPlane(kDepth, 0.0, 0.0)),
          SmallCamera(),
          1.0,
          ObservedSurfaceOptions()};
}

FeatureOptions DenseFeatures() {
  FeatureOptions options;
  options.count = 100;
  options.pixels.min_distance = 6.0;
  return options;
}

// Returns the median difference of the matches from a slide of the whole sheet.
double MedianError(const FeaturePoints& features,
                   const DeformableMap& map,
                   const Eigen::Vector3d& slide) {
  std::vector<double> errors;
  for (const PointMatch& m : features.Matches(map)) {
    errors.push_back((map.state().camera_from_map * m.in_map + slide - m.in_camera).norm());
  }
  EXPECT_FALSE(errors.empty());
  return Median(errors);
}

// A textured sheet that slides along itself, which its depth does not show.
class FeaturePointsTest : public ::testing::Test {
 protected:
  FeaturePointsTest() : surface_(Sheet()), features_(DenseFeatures()) {
    map_.SetCamera(Motion(0.4, {1.0, 1.0, 3.0}, {0.5, -1.0, 2.0}));
    GrowMap({}, surface_, ColorImage(), 0, MapGrowthOptions(), &map_);
    features_.Track(
        TexturedPicture({0, 0}, EvenLight), surface_, map_, map_.state().camera_from_map);
    features_.Replenish(surface_, map_);
    born_ = features_.size();
  }

  void Show(const Eigen::Vector2d& shift) {
    features_.Track(
        TexturedPicture(shift, EvenLight), surface_, map_, map_.state().camera_from_map);
  }

  ObservedSurface surface_;
  DeformableMap map_;
  FeaturePoints features_;
  int born_ = 0;
};

TEST_F(FeaturePointsTest, SitOnTheMapWhereTheyWereBorn) {
  EXPECT_GT(born_, 60);
  EXPECT_LE(born_, 100);
  for (const PointMatch& m : features_.Matches(map_)) {
    EXPECT_LT((map_.state().camera_from_map * m.in_map - m.in_camera).norm(), 1e-12);
    EXPECT_NEAR(m.in_camera.z(), kDepth, 4.0 * kFloatRounding * kDepth);
  }
}

TEST_F(FeaturePointsTest, FollowASheetThatSlidesAlongItself) {
  for (int frame = 1; frame <= 4; ++frame) {
    const Eigen::Vector2d shift = frame * Eigen::Vector2d(1.7, -0.9);
    Show(shift);
    EXPECT_GT(features_.size(), 0.8 * born_);
    // A tenth of a pixel for each step.
    EXPECT_LT(MedianError(features_, map_, kPixel * Eigen::Vector3d(shift.x(), shift.y(), 0.0)),
              0.1 * frame * kPixel);
  }
}

TEST_F(FeaturePointsTest, AreObservationsOfTheSamePlaces) {
  Show({2.0, 1.0});
  const std::vector<PointMatch> matches = features_.Matches(map_);
  const std::vector<MapObservation> observations = features_.Observations();
  ASSERT_EQ(matches.size(), observations.size());
  ASSERT_EQ(static_cast<int>(matches.size()), features_.size());
  for (std::size_t k = 0; k < matches.size(); ++k) {
    const MapObservation& o = observations[k];
    EXPECT_EQ(o.target, matches[k].in_camera);
    EXPECT_EQ(WarpPoint(map_.graph(), map_.state(), o.binding, o.position), matches[k].in_map);
  }
}

TEST_F(FeaturePointsTest, StayAttachedToAMapThatMoves) {
  const Eigen::Vector3d t(0.3, -0.2, 0.1);
  const std::vector<PointMatch> before = features_.Matches(map_);
  for (int j = 0; j < map_.graph().num_nodes(); ++j) {
    EditNode(&map_, j, [&](double* parameters) { MutableNodeTranslation(parameters) += t; });
  }
  const std::vector<PointMatch> after = features_.Matches(map_);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_LT((after[k].in_map - before[k].in_map - t).norm(), 1e-12);
  }
}

TEST_F(FeaturePointsTest, AreGoneWhereThereIsNoSurface) {
  DepthImage depth = RenderDepth(SmallCamera(), TiltedPlane(kDepth, 0.0, 0.0));
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 80; ++u) depth(u, v) = 0.0F;
  }
  const ObservedSurface half(depth, SmallCamera(), 1.0, ObservedSurfaceOptions());
  features_.Track(TexturedPicture({0, 0}, EvenLight), half, map_, map_.state().camera_from_map);
  EXPECT_GT(features_.size(), 0.3 * born_);
  EXPECT_LT(features_.size(), 0.7 * born_);
  for (const PointMatch& m : features_.Matches(map_)) EXPECT_GT(m.in_camera.x(), 0.0);
  // New corners are searched on the remaining part.
  features_.Replenish(half, map_);
  for (const PointMatch& m : features_.Matches(map_)) EXPECT_GT(m.in_camera.x(), 0.0);
}

// The tissue ends in the middle of the picture. It slides, and what is behind it slides elsewhere.
TEST_F(FeaturePointsTest, AreNotPulledByWhatIsBehindTheRimOfTheTissue) {
  constexpr int kRim = 80;
  const auto picture = [&](const Eigen::Vector2d& shift, const Eigen::Vector2d& behind) {
    ColorImage image = TexturedPicture(shift, EvenLight);
    const ColorImage other = TexturedPicture(behind, EvenLight, /*seed=*/5);
    for (int v = 0; v < image.height(); ++v) {
      for (int u = kRim; u < image.width(); ++u) image(u, v) = other(u, v);
    }
    return image;
  };
  DepthImage depth = RenderDepth(SmallCamera(), TiltedPlane(kDepth, 0.0, 0.0));
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = kRim; u < depth.width(); ++u) depth(u, v) = 0.0F;
  }
  const ObservedSurface tissue(depth, SmallCamera(), 1.0, ObservedSurfaceOptions());
  FeaturePoints features(DenseFeatures());
  const CameraPose& camera = map_.state().camera_from_map;
  features.Track(picture({0, 0}, {0, 0}), tissue, map_, camera);
  features.Replenish(tissue, map_);
  constexpr int kFrames = 6;
  const Eigen::Vector2d step(0.0, 1.0);
  for (int frame = 1; frame <= kFrames; ++frame) {
    features.Track(picture(frame * step, -2.0 * frame * step), tissue, map_, camera);
  }
  const Eigen::Vector3d slide = kPixel * kFrames * Eigen::Vector3d(step.x(), step.y(), 0.0);
  std::vector<double> errors;
  for (const PointMatch& m : features.Matches(map_)) {
    if (SmallCamera().Project(m.in_camera).x() < kRim - PatchTemplate::kRadius) continue;
    errors.push_back((camera * m.in_map + slide - m.in_camera).norm() / kPixel);
  }
  EXPECT_GT(errors.size(), 4u);
  EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 0.2);
}

TEST_F(FeaturePointsTest, DropThoseThatTheSolvedMapContradicts) {
  // To the right of the middle the tissue slides by 4 pixels, and the map does not follow it there.
  ColorImage torn = TexturedPicture({0.4, 0.0}, EvenLight);
  const ColorImage slid = TexturedPicture({4.4, 0.0}, EvenLight);
  for (int v = 0; v < 120; ++v) {
    for (int u = 120; u < 160; ++u) torn(u, v) = slid(u, v);
  }
  features_.Track(torn, surface_, map_, map_.state().camera_from_map);
  const int before = features_.size();
  const double deviation = features_.DropOutliers(map_, 1e-4);
  // The other corners are off by 0.4 pixels: six times 1.48 of that is 3.6 pixels.
  EXPECT_NEAR(deviation, 1.4826 * 0.4 * kPixel, 0.15 * kPixel);
  EXPECT_LT(features_.size(), before - 3);
  EXPECT_GT(features_.size(), 0.6 * before);
  for (const PointMatch& m : features_.Matches(map_)) {
    EXPECT_LE((map_.state().camera_from_map * m.in_map - m.in_camera).norm(), 6.0 * deviation);
  }
  // With a lower bound of the deviation, corners with smaller errors are not removed.
  const int left = features_.size();
  EXPECT_EQ(features_.DropOutliers(map_, 10.0), 10.0);
  EXPECT_EQ(features_.size(), left);
}

TEST_F(FeaturePointsTest, AreFoundAgainWhenTheyComeBack) {
  const std::vector<PointMatch> before = features_.Matches(map_);
  ColorImage black(160, 120);
  features_.Track(black, surface_, map_, map_.state().camera_from_map);
  EXPECT_EQ(features_.size(), 0);
  EXPECT_EQ(features_.num_known(), born_);
  // The sheet is back, a little aside.
  const Eigen::Vector2d shift(3.0, -2.0);
  features_.Track(TexturedPicture(shift, EvenLight), surface_, map_, map_.state().camera_from_map);
  features_.Recall(surface_, map_, map_.state().camera_from_map);
  EXPECT_GT(features_.size(), 0.7 * born_);
  EXPECT_EQ(features_.num_known(), born_);
  EXPECT_LT(MedianError(features_, map_, kPixel * Eigen::Vector3d(shift.x(), shift.y(), 0.0)),
            0.1 * kPixel);
}

// The method of Lucas and Kanade alone adds up its errors.
TEST_F(FeaturePointsTest, DoNotDrift) {
  for (int frame = 1; frame <= 40; ++frame) {
    const Eigen::Vector2d shift(3.0 * std::sin(0.5 * frame), 2.0 * std::sin(0.3 * frame));
    Show(shift);
    EXPECT_LT(MedianError(features_, map_, kPixel * Eigen::Vector3d(shift.x(), shift.y(), 0.0)),
              0.1 * kPixel)
        << frame;
  }
  EXPECT_GT(features_.size(), 0.7 * born_);
}

// The camera turns about its axis and steps aside, where no prediction reaches.
// Returns a picture whose right half has slid by `shift` pixels, and has a share of another look.
ColorImage PictureOfAPulledHalf(double shift, double share) {
  ColorImage picture = TexturedPicture({0.0, 0.0}, EvenLight);
  const ColorImage before = TexturedPicture({shift, 0.0}, EvenLight);
  const ColorImage after = TexturedPicture({shift, 0.0}, EvenLight, /*seed=*/2);
  for (int v = 0; v < picture.height(); ++v) {
    for (int u = picture.width() / 2; u < picture.width(); ++u) {
      for (int c = 0; c < 3; ++c) {
        picture(u, v)[c] = static_cast<std::uint8_t>(
            std::lround((1.0 - share) * before(u, v)[c] + share * after(u, v)[c]));
      }
    }
  }
  return picture;
}

// Tissue that is pulled changes its look. Its corners are all that shows where it slides to, while
// those of tissue that stays are worth no drift.
TEST_F(FeaturePointsTest, StayWithTissueThatMovesAsNobodyForesawThoughItsLookChanges) {
  const CameraPose& pose = map_.state().camera_from_map;
  const auto followed = [&](double pixels_per_frame) {
    FeaturePoints features(DenseFeatures());
    features.Track(TexturedPicture({0, 0}, EvenLight), surface_, map_, pose);
    features.Replenish(surface_, map_);
    for (int k = 1; k <= 6; ++k) {
      const double shift = pixels_per_frame * (2.0 + k);
      features.Track(PictureOfAPulledHalf(shift, 0.13 * k), surface_, map_, pose);
    }
    const std::vector<PointMatch> matches = features.Matches(map_);
    return std::count_if(matches.begin(), matches.end(), [](const PointMatch& m) {
      return m.in_camera.x() > 10.0 * kPixel;
    });
  };
  const auto pulled = followed(1.0);
  EXPECT_GT(pulled, 30);
  EXPECT_GT(pulled, 2 * followed(0.0));
}

TEST_F(FeaturePointsTest, RecognizeTheCamera) {
  const Eigen::Vector2d shift(35.0, 20.0);
  features_.Track(TexturedPicture(shift, EvenLight), surface_, map_, map_.state().camera_from_map);
  features_.Clear();
  const std::optional<CameraPose> pose = features_.Recognize(surface_, map_);
  ASSERT_TRUE(pose.has_value());
  const CameraPose motion = *pose * map_.state().camera_from_map.Inverse();
  const Eigen::Vector3d center(0.0, 0.0, kDepth);
  EXPECT_LT((motion * center - center - kPixel * Eigen::Vector3d(shift.x(), shift.y(), 0.0)).norm(),
            0.5 * kPixel);
  EXPECT_LT(motion.rotation.angularDistance(CameraPose().rotation), 0.02);
}

TEST_F(FeaturePointsTest, RecognizeNothingInAnotherPicture) {
  features_.Track(
      TexturedPicture({0, 0}, EvenLight, /*seed=*/9), surface_, map_, map_.state().camera_from_map);
  EXPECT_FALSE(features_.Recognize(surface_, map_).has_value());
}

// A part of the tissue slides as a whole; single corners that are elsewhere are confused.
TEST_F(FeaturePointsTest, TrustWhatMovesLikeItsNeighbours) {
  ColorImage torn = TexturedPicture({0.0, 0.0}, EvenLight);
  const ColorImage slid = TexturedPicture({5.0, 0.0}, EvenLight);
  for (int v = 0; v < 120; ++v) {
    for (int u = 80; u < 160; ++u) torn(u, v) = slid(u, v);
  }
  features_.Track(torn, surface_, map_, map_.state().camera_from_map);
  int moved = 0, trusted = 0;
  for (const PointMatch& m : features_.Matches(map_)) {
    const Eigen::Vector3d motion = m.in_camera - map_.state().camera_from_map * m.in_map;
    // Well inside of the part that slides.
    if (m.in_camera.x() < 1.2 || std::abs(motion.x() - 5.0 * kPixel) > kPixel) continue;
    ++moved;
    if (m.weight > 0.5) ++trusted;
  }
  EXPECT_GT(moved, 10);
  EXPECT_GT(trusted, 0.8 * moved);
}

TEST(FeaturePoints, WaitForAMap) {
  FeaturePoints features(DenseFeatures());
  const ObservedSurface surface = Sheet();
  const DeformableMap map;
  features.Track(TexturedPicture({0, 0}, EvenLight), surface, map, {});
  features.Replenish(surface, map);
  EXPECT_EQ(features.size(), 0);
  EXPECT_TRUE(features.Matches(map).empty());
  EXPECT_TRUE(features.Observations().empty());
}

}  // namespace
}  // namespace ceres_ed
