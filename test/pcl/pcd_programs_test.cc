#include <ceres_ed/io/cloud_io.h>

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <test/cli/ed_fit_test_util.h>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

// The points of a ring as a PCD.
void WriteRingPcd(const std::string& path, const RingOptions& options) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "ring.ply", RingPly(options));
  const StatusOr<LoadedCloud> ring = LoadCloud(directory / "ring.ply");
  ASSERT_TRUE(ring.ok()) << ring.status().message();
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const Eigen::Vector3d& point : ring->cloud.points) {
    const Eigen::Vector3f p = point.cast<float>();
    cloud.push_back({p.x(), p.y(), p.z()});
  }
  ASSERT_EQ(pcl::PCDWriter().writeBinary(path, cloud), 0);
}

TEST(PcdPrograms, FitTakesAndMakesPcdFiles) {
  const TemporaryDirectory directory;
  RingOptions options;
  options.faces = false;
  WriteRingPcd(directory / "source.pcd", options);
  options.bent = true;
  WriteRingPcd(directory / "target.pcd", options);
  const ProgramResult result = RunProgramFile(
      AppPath("ed_fit"),
      {directory / "source.pcd", directory / "target.pcd", "--output=" + (directory / "out.pcd")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  pcl::PointCloud<pcl::PointXYZ> fitted;
  ASSERT_EQ(pcl::PCDReader().read(directory / "out.pcd", fitted), 0);
  EXPECT_EQ(fitted.size(), static_cast<std::size_t>(options.size()));
}

TEST(PcdPrograms, AModuleThatCannotBeLoadedIsOneSentence) {
  const TemporaryDirectory directory;
  WriteRingPcd(directory / "source.pcd", RingOptions());
  WriteBytes(directory / CERES_ED_PCL_MODULE, "no library");
  ASSERT_EQ(setenv("CERES_ED_MODULES", directory.path().c_str(), 1), 0);
  const ProgramResult result = RunProgramFile(
      AppPath("ed_fit"),
      {directory / "source.pcd", directory / "source.pcd", "--output=" + (directory / "out.ply")});
  unsetenv("CERES_ED_MODULES");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              ::testing::HasSubstr("source.pcd: PCD files need ceres_ed's module for PCL: install "
                                   "the package ceres-ed-pcl, or libpcl-dev and build again ("));
  EXPECT_EQ(SplitLines(result.err).size(), 1u) << result.err;
}

}  // namespace
}  // namespace ceres_ed
