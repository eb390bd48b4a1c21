#include <ceres_ed/pipeline/apply/choose_grid.h>

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

const FieldFormat& Format(const std::string& path) { return **FieldFormatOf(path); }

FieldSettings Settings() {
  FieldSettings settings;
  settings.field = "f.nrrd";
  return settings;
}

FieldSubject Subject() {
  FieldSubject subject;
  subject.box = Eigen::AlignedBox3d(Eigen::Vector3d(-1, 2, 5), Eigen::Vector3d(9, 4, 6));
  subject.node_spacing = 0.8;
  return subject;
}

TEST(ChooseGrid, CoversTheSurfaceWithItsMargin) {
  const StatusOr<FieldGrid> grid = ChooseGrid(Settings(), Format("f.nrrd"), {}, Subject());
  ASSERT_TRUE(grid.ok()) << grid.status().message();
  // A quarter of the distance of the nodes.
  EXPECT_LT((grid->spacing - Eigen::Vector3d::Constant(0.2)).norm(), 1e-15);
  const Eigen::Vector3d last =
      grid->Position(grid->size[0] - 1, grid->size[1] - 1, grid->size[2] - 1);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(grid->origin[axis], Subject().box.min()[axis] - 1.6 + 1e-9);
    EXPECT_GT(grid->origin[axis], Subject().box.min()[axis] - 1.7 - 1e-9);
    EXPECT_GE(last[axis], Subject().box.max()[axis] + 1.6 - 1e-9);
    EXPECT_LT(last[axis], Subject().box.max()[axis] + 1.7 + 1e-9);
  }
}

TEST(ChooseGrid, TakesBoundsAndSpacingToTheLetter) {
  FieldSettings settings = Settings();
  settings.bounds = "0,1, 0,2,-1,-0.5";
  settings.spacing = 0.1;
  const StatusOr<FieldGrid> grid = ChooseGrid(settings, Format("f.nrrd"), {}, Subject());
  ASSERT_TRUE(grid.ok()) << grid.status().message();
  EXPECT_EQ(grid->size, (std::array<int, 3>{11, 21, 6}));
  EXPECT_LT((grid->origin - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
}

TEST(ChooseGrid, LiesAtTheSamePlaceInOtherCoordinates) {
  FieldSettings settings = Settings();
  settings.frame = SurfaceAxes::kRas;
  settings.unit = SurfaceUnit::kMetres;
  const FileFrame frame = FrameOfFile(FieldSpace::kLps, settings.frame, settings.unit);
  const StatusOr<FieldGrid> grid = ChooseGrid(settings, Format("f.nrrd"), frame, Subject());
  ASSERT_TRUE(grid.ok()) << grid.status().message();
  EXPECT_LT((grid->spacing - Eigen::Vector3d::Constant(200.0)).norm(), 1e-9);
  const Eigen::Vector3d last =
      grid->Position(grid->size[0] - 1, grid->size[1] - 1, grid->size[2] - 1);
  const Eigen::Vector3d center = frame.FromFile(0.5 * (grid->origin + last));
  EXPECT_LT((center - Subject().box.center()).norm(), 1e-12);
  EXPECT_EQ(grid->direction, Eigen::Matrix3d::Identity());
}

TEST(ChooseGrid, SaysWhichSpacingFits) {
  FieldSettings settings = Settings();
  settings.spacing = 0.001;
  StatusOr<FieldGrid> grid = ChooseGrid(settings, Format("f.nrrd"), {}, Subject());
  ASSERT_FALSE(grid.ok());
  const std::string message = grid.status().message();
  EXPECT_THAT(message, HasSubstr("f.nrrd: a field with the spacing 0.001 has "));
  EXPECT_THAT(message, HasSubstr("expected at most 512 (--max_mb); --spacing="));
  // What it says fits, and is nearly the best.
  settings.spacing = std::stod(message.substr(message.find("--spacing=") + 10));
  grid = ChooseGrid(settings, Format("f.nrrd"), {}, Subject());
  ASSERT_TRUE(grid.ok()) << grid.status().message();
  EXPECT_LE(FieldMegabytes(Format("f.nrrd"), *grid), 512.0);
  settings.spacing *= 0.9;
  EXPECT_FALSE(ChooseGrid(settings, Format("f.nrrd"), {}, Subject()).ok());
}

TEST(ChooseGrid, StaysSmallByDefaultAndScalesWithTheUnit) {
  FieldSubject subject = Subject();
  subject.node_spacing = 1e-3;
  const FieldGrid fine = *ChooseGrid(Settings(), Format("f.nrrd"), {}, subject);
  EXPECT_LE(fine.num_points(), 2000000u);
  EXPECT_GT(fine.num_points(), 1800000u);
  subject.box.min() *= 1000.0;
  subject.box.max() *= 1000.0;
  subject.node_spacing *= 1000.0;
  const FieldGrid large = *ChooseGrid(Settings(), Format("f.nrrd"), {}, subject);
  EXPECT_EQ(large.size, fine.size);
  EXPECT_LT((large.origin - 1000.0 * fine.origin).norm(), 1e-9);
}

TEST(ChooseGrid, NeedsAnExtent) {
  FieldSubject subject;
  subject.box.extend(Eigen::Vector3d(1, 2, 3));
  StatusOr<FieldGrid> grid = ChooseGrid(Settings(), Format("f.nrrd"), {}, subject);
  ASSERT_FALSE(grid.ok());
  EXPECT_THAT(grid.status().message(), HasSubstr("expected --spacing and --bounds"));
  FieldSettings settings = Settings();
  settings.spacing = 0.5;
  settings.bounds = "0,1,0,1,0,1";
  EXPECT_TRUE(ChooseGrid(settings, Format("f.nrrd"), {}, subject).ok());
}

TEST(ParseBounds, SaysWhatItExpects) {
  EXPECT_FALSE((*ParseBounds("")).has_value());
  for (const std::string bad :
       {"1", "0,1,0,1,0", "0,1,0,1,1,0", "0,1,0,1,0,x", "0,1,0,1,0,inf", "0,1,0,1,0,1,2"}) {
    EXPECT_THAT(ParseBounds(bad).status().message(), HasSubstr("expected x0,x1,y0,y1,z0,z1"))
        << bad;
  }
}

}  // namespace
}  // namespace ceres_ed
