// ed_slam on a sequence of six small frames: what it writes.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <test/cli/ed_slam_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kNumFrames = 6;

class EdSlamOutputTest : public EdSlamTest {
 protected:
  EdSlamOutputTest() { WriteBumpySequence(Sequence(), kNumFrames); }
};

TEST_F(EdSlamOutputTest, WritesARowAPoseAndACloudForEachFrame) {
  const ProgramResult result = Run("out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, StartsWith("ed_slam: native (guessed"));
  EXPECT_EQ(SplitLines(result.err).size(), 1u);
  EXPECT_THAT(SplitLines(ReadBytes(dir_ / "out/frames.csv"))[0],
              StartsWith("frame,status,t_total,t_load,t_associate,t_camera,t_level1,t_level2,"
                         "t_warp,t_grow,nodes,pr,active,updated_pi,points,map_points,inliers,"
                         "rms_plane,energy"));
  EXPECT_THAT(Statuses(),
              ElementsAre("initialized", "tracked", "tracked", "tracked", "tracked", "tracked"));
  const auto poses = ReadTrajectory(dir_ / "out/trajectory.txt");
  ASSERT_TRUE(poses.ok()) << poses.status().message();
  ASSERT_EQ(poses->size(), 6u);
  auto rows = Frames();
  for (int frame = 0; frame < kNumFrames; ++frame) {
    auto& row = rows[frame];
    EXPECT_EQ(row["frame"], std::to_string(frame));
    const LoadedCloud live = Load("out/live/" + FrameName(frame, "ply"));
    EXPECT_EQ(std::to_string(live.cloud.size()), row["map_points"]);
    // Stages are parts of t_total, and t_total is neither reading nor writing.
    double stages = 0.0;
    for (const auto& [column, value] : row) {
      const bool stage = column.rfind("t_", 0) == 0 && column != "t_total" && column != "t_load" &&
                         column != "t_write";
      stages += stage && !value.empty() ? std::stod(value) : 0.0;
    }
    EXPECT_LE(stages, std::stod(row["t_total"]) + 20e-6);
    EXPECT_GT(std::stod(row["t_load"]), 0.0);
    // The camera went half a millimetre a frame along x, the sheet stood still.
    EXPECT_EQ((*poses)[frame].time_s, frame);
    const Eigen::Vector3d truth(0.0005 * frame, 0.0, 0.0);
    EXPECT_LT(((*poses)[frame].world_from_camera.translation - truth).norm(), 0.4e-3);
  }
}

TEST_F(EdSlamOutputTest, ClearsAwayWhatAnEarlierRunHasLeft) {
  ASSERT_EQ(Run("out").exit_code, 0);
  WriteBytes(dir_ / "out/live/000004.ply.tmp.123.0", "half");
  WriteBytes(dir_ / "out/tracks.csv", "old");
  WriteBytes(dir_ / "out/notes.txt", "mine");
  WriteBytes(dir_ / "out/live/other.ply", "mine");
  ASSERT_EQ(Run("out", {"--last=2", "--live_every=2", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(Exists("out/live/000004.ply.tmp.123.0"));
  EXPECT_FALSE(Exists("out/live/000005.ply"));
  EXPECT_FALSE(Exists("out/live/000001.ply"));
  EXPECT_FALSE(Exists("out/tracks.csv"));
  EXPECT_TRUE(Exists("out/live/000002.ply"));
  EXPECT_TRUE(Exists("out/notes.txt"));
  EXPECT_TRUE(Exists("out/live/other.ply"));
  EXPECT_EQ(Statuses().size(), 3u);
}

TEST_F(EdSlamOutputTest, WritesMasksOnRequest) {
  ASSERT_EQ(Run("out", {"--last=1", "--write_masks"}).exit_code, 0);
  const auto depth = ReadDepthImage(dir_ / ("seq/depth/" + FrameName(1, "png")), 1.0);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  const auto mask = ReadMaskImage(dir_ / ("out/masks/" + FrameName(1, "png")));
  ASSERT_TRUE(mask.ok()) << mask.status().message();
  // There is no tool before this sheet.
  ASSERT_EQ(mask->pixels().size(), depth->pixels().size());
  for (std::size_t i = 0; i < mask->pixels().size(); ++i) {
    ASSERT_EQ(mask->pixels()[i] != 0, depth->pixels()[i] > 0.0F) << i;
  }
  ASSERT_EQ(Run("out", {"--last=0", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(Exists("out/masks/" + FrameName(1, "png")));
}

TEST_F(EdSlamOutputTest, KeepsAFinishedResultUnlessToldToReplaceIt) {
  ASSERT_EQ(Run("out", {"--last=1"}).exit_code, 0);
  const std::string frames = ReadBytes(dir_ / "out/frames.csv");
  const ProgramResult refused = Run("out");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(SplitLines(refused.err).size(), 1u) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("--output=" + (dir_ / "out") + " holds a result already"));
  EXPECT_THAT(refused.err, HasSubstr("--resume"));
  EXPECT_THAT(refused.err, HasSubstr("--overwrite"));
  EXPECT_EQ(ReadBytes(dir_ / "out/frames.csv"), frames);
  EXPECT_EQ(Run("out", {"--resume", "--last=2"}).exit_code, 0);
  EXPECT_EQ(Frames().size(), 3u);
  EXPECT_EQ(Run("out", {"--overwrite", "--last=0"}).exit_code, 0);
  EXPECT_EQ(Frames().size(), 1u);
}

TEST_F(EdSlamOutputTest, ReplacesWhatAFailedRunHasLeft) {
  std::filesystem::create_directories(dir_ / "out");
  WriteBytes(dir_ / "out/report.json", R"({"program": "ed_slam", "status": "failed"})");
  EXPECT_EQ(Run("out", {"--last=0"}).exit_code, 0);
  EXPECT_EQ(Report()["status"], "done");
}

TEST_F(EdSlamOutputTest, RefusesToWriteIntoItsInput) {
  for (const std::string output : {"seq", "seq/../seq/", "seq/depth"}) {
    const ProgramResult refused = Run(output, {"--overwrite"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("is a folder of the sequence, expected another one"));
  }
  EXPECT_FALSE(Exists("seq/frames.csv"));
  EXPECT_FALSE(Exists("seq/depth/frames.csv"));
  EXPECT_EQ(Run("seq/out", {"--last=0"}).exit_code, 0);
}

TEST_F(EdSlamOutputTest, WritesCovariancesOnRequestAndChangesNothingElse) {
  const std::vector<std::string> flags = {"--covariance", "--checkpoint_every=2"};
  ASSERT_EQ(Run("out", flags).exit_code, 0);
  ASSERT_EQ(Run("plain").exit_code, 0);
  for (const char* name : {"map.ply", "trajectory.txt", "graph.ply"}) {
    EXPECT_TRUE(ReadBytes(dir_ / (std::string("out/") + name)) ==
                ReadBytes(dir_ / (std::string("plain/") + name)))
        << name;
  }
  EXPECT_FALSE(Exists("plain/map_covariance.ply"));
  EXPECT_FALSE(Exists("plain/camera_covariance.csv"));

  // The steps of the camera are known: half a millimetre along x.
  const auto poses = ReadTrajectory(dir_ / "out/trajectory.txt");
  ASSERT_TRUE(poses.ok()) << poses.status().message();
  auto rows = ReadCsv(dir_ / "out/camera_covariance.csv");
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k]["frame"], std::to_string(k + 1));
    const Eigen::Vector3d step =
        (*poses)[k + 1].world_from_camera.translation - (*poses)[k].world_from_camera.translation;
    const char* const names[] = {"tx_tx", "ty_ty", "tz_tz"};
    for (int axis = 0; axis < 3; ++axis) {
      const double deviation = std::sqrt(std::stod(rows[k][names[axis]]));
      EXPECT_GT(deviation, 1e-8);
      EXPECT_LT(deviation, 1e-3);
      EXPECT_LT(std::abs(step[axis] - (axis == 0 ? 0.0005 : 0.0)), 5.0 * deviation) << axis;
    }
  }
  const LoadedCloud points = Load("out/map_covariance.ply");
  EXPECT_EQ(points.cloud.size(), Load("out/map.ply").cloud.size());
  const std::vector<double>& deviations = points.document.Find("vertex")->Find("std_dev")->values;
  const auto is_known = [](double deviation) { return deviation > 0.0 && deviation < 1e-2; };
  EXPECT_GT(std::count_if(deviations.begin(), deviations.end(), is_known),
            0.8 * static_cast<double>(deviations.size()));
}

TEST_F(EdSlamOutputTest, ResumesWithTheSameCovariances) {
  const std::vector<std::string> flags = {"--covariance", "--checkpoint_every=2"};
  ASSERT_EQ(Run("whole", flags).exit_code, 0);
  ASSERT_EQ(Run("out", {flags[0], flags[1], "--last=3"}).exit_code, 0);
  ASSERT_EQ(Run("out", {flags[0], flags[1], "--resume"}).exit_code, 0);
  ExpectSameContents("whole", "out");
}

TEST_F(EdSlamOutputTest, RefusesCovariancesOfARigidScene) {
  const ProgramResult refused = Run("out", {"--covariance", "--rigid"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("covariance is true and rigid is true"));
}

TEST_F(EdSlamOutputTest, WritesNothingThroughSymbolicLinks) {
  const std::vector<std::string> names = {
      "frames.csv", "trajectory.txt", "map.ply", "graph.ply", "report.json", "tracks.csv"};
  std::filesystem::create_directories(dir_ / "other/live");
  std::filesystem::create_directories(dir_ / "out");
  for (const std::string& name : names) {
    WriteBytes(dir_ / ("other/" + name), "mine");
    std::filesystem::create_symlink("../other/" + name, dir_ / ("out/" + name));
  }
  WriteBytes(dir_ / "other/live/000000.ply", "mine");
  std::filesystem::create_symlink("../other/live", dir_ / "out/live");
  std::filesystem::create_symlink("nowhere", dir_ / "out/masks");
  const std::vector<std::string> flags = {"--last=1", "--write_masks", "--checkpoint_every=1"};
  EXPECT_EQ(Run("out", flags).exit_code, 1) << "a report that is not understood is a result";
  std::filesystem::remove(dir_ / "out/report.json");
  const ProgramResult result = Run("out", flags);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Report()["status"], "done");
  EXPECT_TRUE(Exists("out/live/000001.ply"));
  EXPECT_TRUE(Exists("out/masks/000001.png"));
  EXPECT_FALSE(Exists("out/nowhere"));
  for (const std::string& name : names) EXPECT_EQ(ReadBytes(dir_ / ("other/" + name)), "mine");
  EXPECT_EQ(ReadBytes(dir_ / "other/live/000000.ply"), "mine");
  EXPECT_FALSE(Exists("other/live/000001.ply"));
}

TEST_F(EdSlamOutputTest, ResumesInItsOwnFilesOnly) {
  ASSERT_EQ(Run("out", {"--last=1", "--checkpoint_every=1"}).exit_code, 0);
  std::filesystem::rename(dir_ / "out/map.ply", dir_ / "map.ply");
  std::filesystem::create_symlink("../map.ply", dir_ / "out/map.ply");
  const std::string map = ReadBytes(dir_ / "map.ply");
  EXPECT_EQ(Run("out", {"--resume", "--checkpoint_every=1", "--last=2"}).exit_code, 0);
  EXPECT_TRUE(ReadBytes(dir_ / "map.ply") == map);
  EXPECT_FALSE(std::filesystem::is_symlink(dir_ / "out/map.ply"));

  std::filesystem::rename(dir_ / "out/frames.csv", dir_ / "frames.csv");
  std::filesystem::create_symlink("../frames.csv", dir_ / "out/frames.csv");
  const std::string frames = ReadBytes(dir_ / "frames.csv");
  const ProgramResult refused = Run("out", {"--resume", "--checkpoint_every=1"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("out/frames.csv: is a symbolic link, expected the file"));
  EXPECT_EQ(ReadBytes(dir_ / "frames.csv"), frames);
}

TEST_F(EdSlamOutputTest, PrintsItsSummaryBelowTheProgressBar) {
  if (!HasTerminals()) GTEST_SKIP() << "this machine cannot make terminals";
  const ProgramResult result =
      RunOnTerminal(AppPath("ed_slam"), {Sequence(), "--output=" + (dir_ / "out"), "--last=1"});
  ASSERT_EQ(result.exit_code, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("ed_slam [########################] 2/2"));
  const std::size_t summary = result.out.find("status     done");
  ASSERT_NE(summary, std::string::npos) << result.out;
  const std::size_t line = result.out.rfind('\r', summary);
  // The bar is wiped, and nothing is drawn after that.
  EXPECT_EQ(result.out.substr(line, summary - line), "\r\x1b[K");
  EXPECT_EQ(result.out.find("ed_slam [", summary), std::string::npos);
}

TEST_F(EdSlamOutputTest, LiveCloudsKeepIdsAndBirthPlaces) {
  ASSERT_EQ(Run("out").exit_code, 0);
  const LoadedCloud first = Load("out/live/000000.ply");
  const LoadedCloud last = Load("out/live/000005.ply");
  std::map<int, Eigen::Vector3d> born;
  const PlyElement& rows = *first.document.Find("vertex");
  for (std::size_t i = 0; i < first.cloud.size(); ++i) {
    const int id = static_cast<int>(rows.Find("id")->values[i]);
    // Where it was born is where it is, to the digits of a float.
    const Eigen::Vector3d birth(
        rows.Find("bx")->values[i], rows.Find("by")->values[i], rows.Find("bz")->values[i]);
    EXPECT_TRUE(born.emplace(id, birth).second) << "id " << id << " twice";
    EXPECT_LT((birth - first.cloud.points[i]).norm(), 1e-7);
  }
  const PlyElement& later = *last.document.Find("vertex");
  int old = 0;
  for (std::size_t i = 0; i < last.cloud.size(); ++i) {
    if (later.Find("birth_frame")->values[i] != 0.0) continue;
    ++old;
    const Eigen::Vector3d& birth = born.at(static_cast<int>(later.Find("id")->values[i]));
    EXPECT_EQ(later.Find("bx")->values[i], static_cast<float>(birth.x()));
    // The camera went 2.5 mm.
    const Eigen::Vector3d truth = birth - Eigen::Vector3d(0.0025, 0.0, 0.0);
    EXPECT_LT((last.cloud.points[i] - truth).norm(), 1.5e-3);
  }
  EXPECT_GT(old, 100);
}

TEST_F(EdSlamOutputTest, MapAndGraphAreInMetresOfTheMapFrame) {
  ASSERT_EQ(Run("out").exit_code, 0);
  const LoadedCloud map = Load("out/map.ply");
  EXPECT_EQ(std::to_string(map.cloud.size()), Frames().back()["map_points"]);
  EXPECT_TRUE(map.cloud.HasNormals());
  const PlyElement& rows = *map.document.Find("vertex");
  for (const char* name : {"red", "green", "blue", "id", "birth_frame", "weight"}) {
    EXPECT_NE(rows.Find(name), nullptr) << name;
  }
  const BumpyScene scene;
  double sum = 0.0;
  for (const Eigen::Vector3d& p : map.cloud.points) {
    sum += std::abs(p.z() - scene.Height(p.x(), p.y(), 0));
  }
  // The bumps are 20 mm high, pixels 1.1 mm wide, slopes up to 1.
  EXPECT_LT(sum / static_cast<double>(map.cloud.size()), 0.5e-3);

  const LoadedCloud graph = Load("out/graph.ply");
  EXPECT_EQ(std::to_string(graph.cloud.size()), Frames().back()["nodes"]);
  for (const Eigen::Vector3d& p : graph.cloud.points) EXPECT_NEAR(p.z(), 0.1, 0.03);
  EXPECT_THAT(graph.document.Find("vertex")->Find("rest_z")->values,
              Each(::testing::DoubleNear(0.1, 0.03)));
  EXPECT_EQ(graph.document.Find("edge")->count, Report()["nodes"]["edges"]);
}

TEST_F(EdSlamOutputTest, ReportsTheRun) {
  const ProgramResult result = Run("out");
  ASSERT_EQ(result.exit_code, 0);
  const nlohmann::json report = Report();
  EXPECT_EQ(report["program"], "ed_slam");
  EXPECT_EQ(report["status"], "done");
  EXPECT_EQ(report["mode"], "two_level");
  EXPECT_EQ(report["frames"]["processed"], kNumFrames);
  EXPECT_EQ(report["frames"]["tracked"], kNumFrames - 1);
  EXPECT_EQ(report["frames"]["initialized"], 1);
  EXPECT_EQ(report["frames"]["lost"], 0);
  EXPECT_EQ(report["nodes"]["total"],
            report["nodes"]["pr"].get<int>() + report["nodes"]["pi"].get<int>());
  EXPECT_GT(report["time_s"]["t_total"]["median"], 0.0);
  EXPECT_GT(report["memory_peak_mib"], 1.0);
  EXPECT_EQ(report["flags"]["nodes_in_view"], 40);
  EXPECT_TRUE(report["warnings"].empty());
  const double spacing = report["derived"]["node_spacing"];
  // 40 nodes over what 96 x 72 pixels see of a sheet 0.1 m away: 107 x 80 mm, and its slopes.
  EXPECT_NEAR(spacing, std::sqrt(0.107 * 0.08 / 40), 0.01);
  EXPECT_THAT(result.out, HasSubstr("status     done"));
}

TEST_F(EdSlamOutputTest, SameBytesOnASecondRunAndWithTwoThreads) {
  ASSERT_EQ(Run("out").exit_code, 0);
  ASSERT_EQ(Run("again").exit_code, 0);
  ASSERT_EQ(Run("threads", {"--threads=2"}).exit_code, 0);
  ExpectSameContents("out", "again");
  ExpectSameContents("out", "threads");
}

TEST_F(EdSlamOutputTest, FollowsThePointsOfTrack) {
  const BumpyScene scene;
  std::vector<Eigen::Vector3d> points;
  for (const int u : {20, 50, 70})
    points.push_back(BumpyCamera().BackProject(u, 36, scene.Depth(u, 36, 0)));
  PointCloud cloud;
  cloud.points = points;
  ASSERT_TRUE(WriteCloud(dir_ / "points.ply", cloud).ok());
  const ProgramResult result = Run("out", {"--track=" + (dir_ / "points.ply")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(SplitLines(ReadBytes(dir_ / "out/tracks.csv"))[0], "frame,id,x,y,z,visible");
  auto rows = ReadCsv(dir_ / "out/tracks.csv");
  ASSERT_EQ(rows.size(), points.size() * kNumFrames);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto& row = rows[k];
    const int frame = static_cast<int>(k / points.size());
    EXPECT_EQ(row["frame"], std::to_string(frame));
    EXPECT_EQ(row["id"], std::to_string(k % points.size()));
    EXPECT_EQ(row["visible"], "1");
    const Eigen::Vector3d place(std::stod(row["x"]), std::stod(row["y"]), std::stod(row["z"]));
    const Eigen::Vector3d truth = points[k % points.size()] - scene.CameraPosition(frame);
    EXPECT_LT((place - truth).norm(), 0.6e-3) << "frame " << frame;
  }
}

TEST_F(EdSlamOutputTest, NamesTheRowOfAPointThatIsFarFromTheMap) {
  WriteBytes(dir_ / "points.ply", AsciiMesh({"0 0 0.1", "nan 0 0", "0 0 0.4"}, {}));
  const ProgramResult result = Run("out", {"--track=" + (dir_ / "points.ply")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("points.ply: point 2 at (0, 0, 0.4) m is 0.2"));
}

TEST_F(EdSlamOutputTest, ProgressJsonIsAnObjectAFrame) {
  const ProgramResult result = Run("out", {"--progress=json"});
  ASSERT_EQ(result.exit_code, 0);
  const std::vector<std::string> lines = SplitLines(result.out);
  ASSERT_EQ(lines.size(), 6u);
  for (int frame = 0; frame < kNumFrames; ++frame) {
    const nlohmann::json line = nlohmann::json::parse(lines[frame]);
    EXPECT_EQ(line["frame"], frame);
    EXPECT_EQ(line["status"], frame == 0 ? "initialized" : "tracked");
    EXPECT_EQ(line["done"], frame + 1);
    EXPECT_EQ(line["total"], kNumFrames);
    EXPECT_GT(line["frames_per_s"], 0.0);
    EXPECT_EQ(std::to_string(line["nodes"].get<int>()), Frames()[frame]["nodes"]);
  }
}

TEST_F(EdSlamOutputTest, QuietSaysNothing) {
  const ProgramResult result = Run("out", {"--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST_F(EdSlamOutputTest, OneFrameIsEnough) {
  ASSERT_EQ(Run("out", {"--last=0"}).exit_code, 0);
  EXPECT_THAT(Statuses(), ElementsAre("initialized"));
  EXPECT_GT(Load("out/map.ply").cloud.size(), 100u);
  EXPECT_EQ(Report()["nodes"]["pr"], Report()["nodes"]["total"]);
}

TEST_F(EdSlamOutputTest, TakesTheFramesThatAreAskedFor) {
  // The tissue moves, since the camera does not.
  BumpyScene heaving;
  heaving.camera_step = 0.0;
  heaving.heave = 0.001;
  WriteBumpySequence(Sequence(), kNumFrames, heaving);
  ASSERT_EQ(Run("out",
                {"--first=1",
                 "--last=4",
                 "--step=2",
                 "--features=none",
                 "--mode=batch",
                 "--camera=fixed"})
                .exit_code,
            0);
  auto rows = Frames();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["frame"], "1");
  EXPECT_EQ(rows[1]["frame"], "3");
  EXPECT_EQ(rows[1]["features"], "0");
  EXPECT_EQ(rows[1]["active"], rows[0]["nodes"]);
  EXPECT_TRUE(Exists("out/live/000003.ply"));
}

}  // namespace
}  // namespace ceres_ed
