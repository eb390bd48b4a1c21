#include <ceres_ed/report/html/sequence_page.h>
#include <ceres_ed/report/view/sequence_view.h>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Three frames of a camera that moves by 0.1 along x each time. Point 7 stays, point 8 moves along
// y from the second frame on, and point 9 is dropped after the second one.
SequenceParts SmallRun() {
  SequenceParts parts;
  parts.camera = {100.0, 100.0, 31.5, 23.5, 64, 48};
  parts.log.frames = {0, 1, 2};
  parts.log.statuses = {"initialized", "tracked", "tracked"};
  parts.log.columns = {{"rms_plane", {0.0, 1e-4, 2e-4}}, {"nodes", {4.0, 5.0, 6.0}}};
  for (int frame = 0; frame < 3; ++frame) {
    CameraPose pose;
    pose.translation = {0.1 * frame, 0.0, 0.0};
    parts.map_from_camera[frame] = pose;
    SequenceMoment moment;
    moment.frame = moment.cloud.frame = frame;
    const auto add =
        [&](int id, const Eigen::Vector3d& in_map, int birth, const Eigen::Vector3d& at_birth) {
          moment.cloud.ids.push_back(id);
          moment.cloud.points.push_back(pose.ApplyInverse(in_map));
          moment.cloud.birth_frames.push_back(birth);
          moment.cloud.birth_points.push_back(at_birth);
          moment.cloud.stabilities.push_back(0.5);
          moment.cloud.last_seen.push_back(frame);
        };
    add(7, {0.0, 0.0, 1.0}, 0, {0.0, 0.0, 1.0});
    if (frame > 0) add(8, {0.1, 0.002 * (frame - 1), 1.0}, 1, {0.0, 0.0, 1.0});
    if (frame < 2) add(9, {0.2, 0.0, 1.0}, 0, {0.2, 0.0, 1.0});
    parts.moments.push_back(moment);
  }
  parts.map.points = {{0.0, 0.0, 1.0}, {0.1, 0.002, 1.0}};
  parts.map.normals.assign(2, -Eigen::Vector3d::UnitZ());
  parts.map.colors.assign(2, {10, 20, 30});
  parts.map.ids = {7, 8};
  parts.map.birth_frames = {0, 1};
  parts.map.last_seen = {2, 2};
  parts.map.stabilities = {0.5, 0.75};
  return parts;
}

TEST(SequenceScene, TakesPointsFromTheCamerasToTheMap) {
  const Scene scene = MakeSequenceScene(SmallRun());
  const ViewSurface& map = scene.surfaces[0];
  ASSERT_EQ(map.rows, (std::vector<int>{7, 8, 9}));
  for (int m = 0; m < 3; ++m) {
    EXPECT_NEAR((map.moments->Place(0, m) - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 0.0, 1e-12);
  }
  EXPECT_NEAR(map.moments->Place(1, 2).y(), 0.002, 1e-12);
}

TEST(SequenceScene, HasPointsFromTheirFirstMomentToTheirLast) {
  const Scene scene = MakeSequenceScene(SmallRun());
  const PointMoments& moments = *scene.surfaces[0].moments;
  EXPECT_EQ(moments.first, (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(moments.last, (std::vector<int>{2, 2, 1}));
}

TEST(SequenceScene, KnowsHowFarTissueHasMoved) {
  const Scene scene = MakeSequenceScene(SmallRun());
  const ScalarField* const motion = scene.surfaces[0].Find("motion");
  ASSERT_NE(motion, nullptr);
  EXPECT_NEAR(motion->values[2 * 3 + 1], 2.0, 1e-9);  // Millimetres.
  EXPECT_NEAR(motion->values[2 * 3 + 0], 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(motion->values[1]));
}

TEST(SequenceScene, WithoutLiveCloudsLetsPointsAppearWhenTheyWereSeen) {
  SequenceParts parts = SmallRun();
  for (SequenceMoment& moment : parts.moments) moment.cloud = {};
  const Scene scene = MakeSequenceScene(parts);
  const PointMoments& moments = *scene.surfaces[0].moments;
  EXPECT_TRUE(moments.places.empty());
  EXPECT_EQ(moments.first, (std::vector<int>{0, 1}));
}

TEST(SequenceScene, MarksPointsWhereThePictureShowsThem) {
  SequenceParts parts = SmallRun();
  parts.moments[0].picture = ColorImage(32, 24, {9, 9, 9});  // Half the camera's size.
  const Scene scene = MakeSequenceScene(parts);
  const std::vector<PictureMark>& marks = scene.timeline->pictures[0].marks;
  ASSERT_FALSE(marks.empty());
  EXPECT_EQ(marks[0].id, 7);
  EXPECT_NEAR(marks[0].pixel.x(), 0.5 * 31.5, 1e-9);
}

TEST(SequenceScene, HasTracksInTheMap) {
  SequenceParts parts = SmallRun();
  parts.tracks = {{0, 3, {0.0, 0.0, 1.0}, true}, {2, 3, {-0.2, 0.0, 1.0}, true}};
  const Timeline timeline = *MakeSequenceScene(parts).timeline;
  ASSERT_EQ(timeline.tracks.size(), 1u);
  EXPECT_EQ(timeline.tracks[0].moments, (std::vector<int>{0, 2}));
  EXPECT_NEAR((timeline.tracks[0].places[1] - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 0.0, 1e-12);
}

TEST(ChooseMoments, KeepsFirstAndLast) {
  std::vector<int> frames;
  for (int i = 0; i < 1000; ++i) frames.push_back(3 * i);
  const std::vector<int> chosen = ChooseMoments(frames, 60);
  EXPECT_EQ(chosen.size(), 60u);
  EXPECT_EQ(chosen.front(), 0);
  EXPECT_EQ(chosen.back(), 2997);
  EXPECT_EQ(ChooseMoments({4, 5}, 60), (std::vector<int>{4, 5}));
}

TEST(ShrinkPicture, TakesMeansOfSquares) {
  ColorImage picture(4, 2, {0, 0, 0});
  picture(0, 0) = {200, 100, 40};
  const ColorImage small = ShrinkPicture(picture, 2);
  EXPECT_EQ(small.width(), 2);
  EXPECT_EQ(small.height(), 1);
  EXPECT_EQ(small(0, 0), (Rgb{50, 25, 10}));
}

TEST(SequencePage, EscapesWhatComesFromOutside) {
  SequenceParts parts = SmallRun();
  parts.log.statuses[2] = "</script><script>window.evil = 1</script>";
  SequenceView view;
  view.scene = MakeSequenceScene(parts);
  view.log = parts.log;
  const nlohmann::ordered_json report = {{"program", "ed_slam"},
                                         {"sequence", {{"path", "a/<img src=x onerror=evil()>"}}}};
  const std::string page = SequencePage(report, {}, view, "");
  EXPECT_EQ(page.find("<script>window.evil"), std::string::npos);
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
}

TEST(SequencePage, SaysThatThereAreNoLiveClouds) {
  SequenceView view;
  EXPECT_NE(SequencePage({}, {}, view, "").find("There are no live clouds"), std::string::npos);
}

}  // namespace
}  // namespace ceres_ed
