// ed_eval --sequence on tiny folders whose errors are known.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/image_io.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test/cli/run_program.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace fs = std::filesystem;

constexpr int kFrames = 3;
// A plane at z = 1 moves by this a frame, sideways; one pixel is 0.02 there.
constexpr double kStep = 0.04;
// Clouds are in float, depth in steps of 1e-4.
constexpr double kRound = 1e-6;
constexpr PinholeCamera kCamera = {50.0, 50.0, 49.5, 49.5, 100, 100};

std::string FrameName(int frame, const std::string& extension) {
  return "00000" + std::to_string(frame) + extension;
}

class EdEvalSequence : public ::testing::Test {
 public:
  ~EdEvalSequence() override { fs::remove_all(root_); }

 protected:
  EdEvalSequence() {
    const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(::testing::TempDir()) / (std::string("ed_eval_sequence_") + info->name());
    fs::remove_all(root_);
    for (const char* folder : {"seq/depth", "out/live"}) fs::create_directories(root_ / folder);
    WriteSequence();
    for (int frame = 0; frame < kFrames; ++frame) WriteLive(frame, Eigen::Vector3d::Zero());
  }

  std::string Path(const std::string& name) const { return (root_ / name).string(); }

  void WriteSequence() {
    ASSERT_TRUE(WriteCameraFile(Path("seq/camera.txt"), {kCamera, 10000.0}).ok());
    PointCloud mesh;
    mesh.points = {{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    ASSERT_TRUE(WriteCloud(Path("seq/gt_mesh_000000.ply"), mesh).ok());
    std::ofstream vertices(Path("seq/gt_vertices.f32"), std::ios::binary);
    std::vector<FramePose> poses;
    for (int frame = 0; frame < kFrames; ++frame) {
      for (const Eigen::Vector3d& point : mesh.points) {
        const Eigen::Vector3f moved = (point + Eigen::Vector3d(frame * kStep, 0, 0)).cast<float>();
        vertices.write(reinterpret_cast<const char*>(moved.data()), sizeof(moved));
      }
      poses.push_back({frame, CameraPose()});
      const DepthImage depth(kCamera.width, kCamera.height, 1.0f);
      ASSERT_TRUE(WriteDepthImage(Path("seq/depth/" + FrameName(frame, ".png")), depth, 1e4).ok());
    }
    ASSERT_TRUE(WritePosesFile(Path("seq/poses.txt"), poses).ok());
  }

  // The map in a frame: a grid of points born in frame 0 that moved with the plane, and `error`.
  void WriteLive(int frame, const Eigen::Vector3d& error) {
    PointCloud cloud;
    CloudWriteOptions options;
    for (const char* name : {"id", "birth_frame"}) {
      options.columns.push_back(MakePlyScalar(name, PlyType::kInt32));
    }
    for (const char* name : {"bx", "by", "bz"}) {
      options.columns.push_back(MakePlyScalar(name, PlyType::kFloat32));
    }
    for (int v = 20; v <= 80; v += 3) {
      for (int u = 20; u <= 80; u += 3) {
        const Eigen::Vector3d born = kCamera.BackProject(u, v, 1.0);
        options.columns[0].values.push_back(static_cast<double>(cloud.points.size()));
        options.columns[1].values.push_back(0.0);
        for (int axis = 0; axis < 3; ++axis) options.columns[2 + axis].values.push_back(born[axis]);
        cloud.points.push_back(born + Eigen::Vector3d(frame * kStep, 0, 0) + error);
      }
    }
    ASSERT_TRUE(WriteCloud(Path("out/live/" + FrameName(frame, ".ply")), cloud, options).ok());
  }

  void WriteText(const std::string& name, const std::string& text) {
    std::ofstream(Path(name)) << text;
  }

  ProgramResult Eval(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"--sequence=" + Path("seq"), "--result=" + Path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgramFile(AppPath("ed_eval"), arguments);
  }

  // Returns the report of a run that must succeed.
  nlohmann::json Report() {
    const ProgramResult result = Eval({"--report=" + Path("report.json")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(std::ifstream(Path("report.json")));
  }

  void ExpectRefusal(const std::string& file, const std::string& reason) {
    const ProgramResult result = Eval();
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(SplitLines(result.err).size(), 1u) << result.err;
    EXPECT_THAT(result.err, StartsWith("ed_eval: "));
    EXPECT_THAT(result.err, HasSubstr(file));
    EXPECT_THAT(result.err, HasSubstr(reason));
  }

  fs::path root_;
};

TEST_F(EdEvalSequence, FindsNoErrorInAPerfectResult) {
  const nlohmann::json report = Report();
  EXPECT_EQ(report["program"], "ed_eval");
  const nlohmann::json& truth = report["truth"];
  for (const char* figure : {"surface_all_median",
                             "surface_seen_median",
                             "surface_seen_p95",
                             "tracking_seen_mean",
                             "tracking_seen_median"}) {
    EXPECT_NEAR(truth["summary"][figure]["mean"], 0.0, kRound) << figure;
    EXPECT_EQ(truth["summary"][figure]["frames"], 3) << figure;
  }
  EXPECT_TRUE(truth["summary"]["tracking_hidden_mean"].is_null());
  ASSERT_EQ(truth["frames"].size(), 3u);
  EXPECT_EQ(truth["frames"][2]["frame"], 2);
  EXPECT_EQ(truth["frames"][2]["seen"], 441);
  EXPECT_NEAR(report["depth"]["summary"]["residual_median"]["mean"], 0.0, kRound);
  for (const char* part : {"camera", "tracks_2d", "log"}) EXPECT_TRUE(report[part].is_null());
}

TEST_F(EdEvalSequence, MeasuresKnownErrors) {
  WriteLive(1, {0.0, 0.0, 0.006});
  WriteLive(2, {0.003, 0.004, 0.0});
  const nlohmann::json report = Report();
  const nlohmann::json& summary = report["truth"]["summary"];
  EXPECT_NEAR(summary["surface_seen_median"]["mean"], 0.002, kRound);
  EXPECT_NEAR(summary["surface_seen_median"]["median"], 0.0, kRound);
  EXPECT_NEAR(summary["surface_seen_median"]["max"], 0.006, kRound);
  EXPECT_NEAR(summary["tracking_seen_mean"]["mean"], 0.011 / 3.0, kRound);
  EXPECT_NEAR(report["truth"]["frames"][2]["tracking_seen"]["p50"], 0.005, kRound);
  EXPECT_NEAR(report["depth"]["frames"][1]["residual"]["p50"], 0.006, kRound);

  const std::string out = Eval().out;
  EXPECT_THAT(out, HasSubstr("mean over frames        |    2.000    2.000    2.000 |    3.667"));
}

TEST_F(EdEvalSequence, ComparesTheCameraWithItsTruth) {
  std::vector<TimedPose> poses(kFrames);
  for (int frame = 0; frame < kFrames; ++frame) {
    poses[frame].time_s = frame;
    poses[frame].world_from_camera.translation = {1.0, 2.0, frame == 2 ? 3.09 : 3.0};
  }
  ASSERT_TRUE(WriteTrajectory(Path("out/trajectory.txt"), poses).ok());
  const nlohmann::json report = Report();
  const nlohmann::json& camera = report["camera"];
  EXPECT_NEAR(camera["from_first_frame"]["translation_max"], 0.09, 1e-9);
  EXPECT_NEAR(camera["from_first_frame"]["translation_mean"], 0.03, 1e-9);
  // Centred, the offsets are -0.03, -0.03 and 0.06.
  EXPECT_NEAR(camera["best_alignment"]["translation_mean"], 0.04, 1e-9);
  EXPECT_NEAR(camera["best_alignment"]["rotation_max_deg"], 0.0, 1e-5);

  // Seconds are no frame numbers.
  for (TimedPose& pose : poses) pose.time_s /= 30.0;
  ASSERT_TRUE(WriteTrajectory(Path("out/trajectory.txt"), poses).ok());
  const ProgramResult result = Eval();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("trajectory.txt: time 0.033"));
}

TEST_F(EdEvalSequence, FollowsTracksInThePicture) {
  WriteText("seq/tracks_2d.csv",
            "# frame,track,u,v\n0,0,50.5,50.5\n1,0,52.5,50.5\n2,0,54.5,53.5\n0,1,2,2\n1,1,2,2\n");
  const nlohmann::json tracks = Report()["tracks_2d"];
  EXPECT_EQ(tracks["tracks"], 2);
  EXPECT_EQ(tracks["followed"], 1);
  EXPECT_NEAR(tracks["error"]["p50"], 1.5, 1e-4);
  EXPECT_NEAR(tracks["frames"][1]["error"]["max"], 0.0, 1e-4);
  EXPECT_NEAR(tracks["frames"][2]["error"]["max"], 3.0, 1e-4);
  EXPECT_THAT(Eval().out, HasSubstr("1 of 2 followed"));
}

TEST_F(EdEvalSequence, SumsUpTheLogWithoutTruth) {
  for (const char* name : {"gt_mesh_000000.ply", "gt_vertices.f32", "poses.txt"}) {
    fs::remove(root_ / "seq" / name);
  }
  WriteText("out/frames.csv",
            "frame,status,t_total,t_camera,nodes,pr,map_points,inliers,rms_plane\n"
            "0,ok,0.1,0.01,10,5,100,90,0.001\n"
            "1,skipped,0.2,0.02,10,0,100,0,0\n"
            "2,ok,0.4,0.03,12,6,120,80,0.004\n");
  const nlohmann::json report = Report();
  EXPECT_TRUE(report["truth"].is_null());
  const nlohmann::json& log = report["log"];
  EXPECT_EQ(log["frames"], 3);
  EXPECT_EQ(log["status"], (nlohmann::json{{"ok", 2}, {"skipped", 1}}));
  EXPECT_NEAR(log["rms_plane"]["mean"], 0.0025, 1e-12);
  EXPECT_EQ(log["rms_plane"]["last"], 0.004);
  EXPECT_EQ(log["median_time_s"], (nlohmann::json{{"t_total", 0.2}, {"t_camera", 0.02}}));
  EXPECT_EQ(log["nodes"], 12);
  EXPECT_EQ(log["map_points"], 120);
  EXPECT_THAT(Eval().out, HasSubstr("median ms a frame: total 200.0 camera 20.0"));
}

TEST_F(EdEvalSequence, GoesOnOverADepthImageThatCannotBeRead) {
  WriteText("seq/depth/000001.png", "no picture");
  const nlohmann::json report = Report();
  EXPECT_EQ(report["depth"]["frames"].size(), 2u);
  EXPECT_EQ(report["truth"]["frames"].size(), 3u);
  ASSERT_EQ(report["warnings"].size(), 1u);
  EXPECT_THAT(report["warnings"][0].get<std::string>(), HasSubstr("000001.png"));
}

TEST_F(EdEvalSequence, TakesTheTruthWithoutDepthImages) {
  fs::remove_all(root_ / "seq/depth");
  const nlohmann::json report = Report();
  EXPECT_EQ(report["truth"]["frames"].size(), 3u);
  EXPECT_TRUE(report["depth"].is_null());
}

TEST_F(EdEvalSequence, ReadsOtherLayoutsToo) {
  // The same pictures in the layout of the TUM benchmark, with poses at half a second's distance.
  std::string pictures = "# timestamp filename\n";
  std::string poses = "# timestamp tx ty tz qx qy qz qw\n";
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::string time = std::to_string(100 + frame / 2) + (frame % 2 == 0 ? ".0" : ".5");
    pictures += time + " depth/" + FrameName(frame, ".png") + "\n";
    poses += time + " 0 0 0 0 0 0 1\n";
  }
  WriteText("seq/depth.txt", pictures);
  WriteText("seq/groundtruth.txt", poses);
  WriteText("out/trajectory.txt", "100 1 2 3 0 0 0 1\n100.5 1 2 3 0 0 0 1\n101 1 2 3.5 0 0 0 1\n");
  fs::remove(root_ / "seq/poses.txt");
  const nlohmann::json report = Report();
  EXPECT_EQ(report["truth"]["frames"].size(), 3u);
  EXPECT_NEAR(report["truth"]["summary"]["tracking_seen_mean"]["mean"], 0.0, kRound);
  EXPECT_EQ(report["depth"]["frames"].size(), 3u);
  EXPECT_NEAR(report["camera"]["from_first_frame"]["translation_max"], 0.5, 1e-9);
}

TEST_F(EdEvalSequence, RefusesAResultWithoutLiveClouds) {
  fs::remove_all(root_ / "out/live");
  ExpectRefusal("out/live", "no live clouds");
}

TEST_F(EdEvalSequence, RefusesALiveCloudWithoutIdsOrBirths) {
  PointCloud cloud;
  cloud.points = {{0, 0, 1}};
  CloudWriteOptions options;
  const std::string path = Path("out/live/000001.ply");
  ASSERT_TRUE(WriteCloud(path, cloud, options).ok());
  ExpectRefusal("out/live/000001.ply", "no property 'id'");
  options.columns.push_back(MakePlyScalar("id", PlyType::kInt32, {0.0}));
  options.columns.push_back(MakePlyScalar("birth_frame", PlyType::kInt32, {0.0}));
  ASSERT_TRUE(WriteCloud(path, cloud, options).ok());
  ExpectRefusal("out/live/000001.ply", "bx by bz");
  options.columns[0].values[0] = -1.0;
  ASSERT_TRUE(WriteCloud(path, cloud, options).ok());
  ExpectRefusal("out/live/000001.ply", "vertex 0: id is -1");
}

TEST_F(EdEvalSequence, RefusesATruthOfAnotherSize) {
  fs::resize_file(root_ / "seq/gt_vertices.f32", 12 * 4 * kFrames - 4);
  ExpectRefusal("gt_vertices.f32", "140 bytes");
  fs::resize_file(root_ / "seq/gt_vertices.f32", 12 * 4 * (kFrames - 1));
  ExpectRefusal("gt_vertices.f32", "3 frames");
  fs::remove(root_ / "seq/gt_vertices.f32");
  ExpectRefusal("gt_vertices.f32", "");
}

TEST_F(EdEvalSequence, RefusesFramesThatTheSequenceLacks) {
  fs::copy_file(root_ / "out/live/000002.ply", root_ / "out/live/000007.ply");
  ExpectRefusal("out/live/000007.ply", "no frame 7");
}

TEST_F(EdEvalSequence, NamesTheLineOfABadTable) {
  WriteText("seq/tracks_2d.csv", "frame,track,u,v\n0,0,1,x\n");
  ExpectRefusal("tracks_2d.csv: line 2", "v is 'x'");
  fs::remove(root_ / "seq/tracks_2d.csv");
  WriteText("out/frames.csv", "frame,status,t_total\n0,ok,0.1\n1,ok\n");
  ExpectRefusal("frames.csv: line 3", "2 fields, expected 3");
}

TEST_F(EdEvalSequence, KeepsItsTwoUsesApart) {
  const std::string sequence = "--sequence=" + Path("seq");
  const std::string result = "--result=" + Path("out");
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{}, "0 arguments given, expected RESULT TARGET, or --sequence=SEQ --result=DIR"},
      {{"a.ply"}, "1 arguments given, expected"},
      {{"a.ply", "b.ply", "c.ply"}, "3 arguments given, expected"},
      {{sequence}, "--sequence without --result"},
      {{result}, "--result without --sequence"},
      {{sequence, result, "a.ply"}, "'a.ply' beside --sequence"},
      {{sequence, result, "--truth=t.ply"}, "--truth beside --sequence"},
      {{sequence, result, "--error_ply=e.ply"}, "--error_ply beside --sequence"}};
  for (const auto& [arguments, reason] : bad) {
    const ProgramResult run = RunProgramFile(AppPath("ed_eval"), arguments);
    EXPECT_EQ(run.exit_code, 1) << reason;
    EXPECT_EQ(run.out, "");
    ASSERT_EQ(SplitLines(run.err).size(), 1u) << run.err;
    EXPECT_THAT(run.err, HasSubstr(reason));
  }
}

}  // namespace
}  // namespace ceres_ed
