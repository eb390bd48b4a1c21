// Every layout that can be written: simulate, write, read, track, evaluate.
#include "../io/io_test_util.h"

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/io/sequence/layouts/stir_truth.h>
#include <ceres_ed/io/sequence/layouts/surgt_truth.h>
#include <ceres_ed/pipeline/evaluate/evaluate_run.h>
#include <ceres_ed/pipeline/simulate/simulate_run.h>
#include <ceres_ed/pipeline/slam/slam_run.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

// A layout and what is expected of it.
struct LayoutCase {
  SequenceFormat format;
  bool is_stereo;
  // The number of the first frame.
  int first_frame;
  // The largest median error of tracking, in metres.
  double max_error;
};

void PrintTo(const LayoutCase& layout, std::ostream* stream) { *stream << NameOf(layout.format); }

constexpr double kMostPixels = 2.0;

// Whether the layout has tracks in the picture as truth.
bool HasTracks(SequenceFormat format) {
  return format == SequenceFormat::kSurgT || format == SequenceFormat::kSuper;
}

class FiguresObserver : public EvaluateObserver {
 public:
  void OnSequence(const SequenceFigures& figures) override { figures_ = figures; }
  const SequenceFigures& figures() const { return figures_; }

 private:
  SequenceFigures figures_;
};

class Layouts : public ::testing::TestWithParam<LayoutCase> {
 protected:
  void Simulate() {
    SimulateSettings settings;
    settings.scene = "heart";
    settings.output = folder_ / "sequence";
    settings.layout = GetParam().format;
    settings.options.kind = SyntheticSceneKind::kHeart;
    settings.options.stereo = GetParam().is_stereo;
    settings.options.width = 256;
    settings.options.height = 192;
    settings.options.frames = 3;
    settings.options.vertices = 2000;
    SimulateObserver observer;
    const Outcome outcome = RunSimulation(settings, &observer);
    ASSERT_TRUE(outcome.done()) << outcome.message;
  }
  void Track() {
    SlamSettings settings;
    if (GetParam().format == SequenceFormat::kStir) settings.predict = Challenge::kStir;
    if (GetParam().format == SequenceFormat::kSurgT) settings.predict = Challenge::kSurgT;
    settings.input = folder_ / "sequence";
    settings.output = folder_ / "result";
    SlamObserver observer;
    const Outcome outcome = RunSlam(settings, Timer(), &observer);
    ASSERT_TRUE(outcome.done()) << outcome.message;
  }
  void Evaluate() {
    EvalSettings settings;
    settings.sequence = folder_ / "sequence";
    settings.result = folder_ / "result";
    const Outcome outcome = RunEvaluation(settings, &observer_);
    ASSERT_TRUE(outcome.done()) << outcome.message;
  }

  nlohmann::json ReadResult(const std::string& name) {
    return nlohmann::json::parse(ReadBytes(folder_ / ("result/" + name)), nullptr, false);
  }
  // The predicted points of the last frame are near those that are given there.
  void CheckStirFiles() {
    const StatusOr<std::optional<StirPoints>> truth = ReadStirPoints(folder_ / "sequence");
    ASSERT_TRUE(truth.ok() && truth->has_value());
    const nlohmann::json flat = ReadResult("stir_2d.json");
    const nlohmann::json solid = ReadResult("stir_3d.json");
    ASSERT_EQ(flat.size(), 1U);
    EXPECT_EQ(flat.begin().key(), (*truth)->clip);
    const nlohmann::json& pixels = flat.begin().value();
    ASSERT_EQ(pixels.size(), (*truth)->start.size());
    ASSERT_EQ(solid.begin().value().size(), pixels.size());
    std::size_t near = 0;
    for (const nlohmann::json& pixel : pixels) {
      for (const Eigen::Vector2d& end : (*truth)->end) {
        if (std::hypot(pixel[0].get<double>() - end.x(), pixel[1].get<double>() - end.y()) < 3.0) {
          ++near;
          break;
        }
      }
    }
    EXPECT_GE(4 * near, 3 * pixels.size());
    // About 5 cm away, in millimetres.
    EXPECT_NEAR(solid.begin().value()[0][2].get<double>(), 50.0, 25.0);
    EXPECT_EQ(ReadResult("stir_tracks.json").begin().value()[0]["frames"].size(), 3U);
  }
  void CheckSurgTFiles() {
    std::filesystem::create_directory(folder_ / "predicted");
    for (int i = 0; i < 3; ++i) {
      const std::string number = std::to_string(i) + ".yaml";
      std::filesystem::copy(folder_ / ("result/pred_rectified_" + number),
                            folder_ / ("predicted/gt_rectified_" + number));
    }
    const auto truth = ReadSurgTBoxes(folder_ / "sequence");
    const auto predicted = ReadSurgTBoxes(folder_ / "predicted");
    ASSERT_TRUE(truth.ok() && predicted.ok());
    ASSERT_EQ(predicted->size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ((*predicted)[i].boxes.count(2), 1U);
      const StereoBox& box = (*predicted)[i].boxes.at(2);
      const StereoBox& expected = (*truth)[i].boxes.at(2);
      EXPECT_LT((box.left.center() - expected.left.center()).norm(), 3.0);
      EXPECT_LT((box.right.center() - expected.right.center()).norm(), 3.0);
      EXPECT_NEAR(box.left.width, expected.left.width, 2.0);
    }
  }

  TemporaryDirectory folder_;
  FiguresObserver observer_;
};

TEST_P(Layouts, AreWrittenReadTrackedAndEvaluated) {
  Simulate();
  const auto sequence = OpenSequence(folder_ / "sequence");
  ASSERT_TRUE(sequence.ok()) << sequence.status().message();
  EXPECT_THAT((*sequence)->description(), HasSubstr(NameOf(GetParam().format) + " (guessed: "));
  EXPECT_EQ((*sequence)->num_frames(), 3);
  EXPECT_EQ((*sequence)->frame_number(0), GetParam().first_frame);
  Track();
  const nlohmann::json latency = ReadResult("report.json")["latency_ms"];
  EXPECT_GT(latency["p50"].get<double>(), 0.0);
  EXPECT_LE(latency["p50"].get<double>(), latency["p95"].get<double>());
  EXPECT_LE(latency["p95"].get<double>(), latency["p99"].get<double>());
  Evaluate();
  const SequenceFigures& figures = observer_.figures();
  ASSERT_EQ(figures.truth.size(), 3U);
  for (const FrameTruthError& error : figures.truth) {
    ASSERT_TRUE(error.tracking_seen.has_value());
    EXPECT_LT(error.tracking_seen->p50, GetParam().max_error) << "frame " << error.frame;
  }
  // The camera of the truth is known in all layouts that are written here.
  EXPECT_TRUE(figures.camera.has_value());
  if (HasTracks(GetParam().format)) {
    ASSERT_TRUE(figures.tracks.has_value());
    ASSERT_TRUE(figures.tracks->error.has_value());
    EXPECT_LT(figures.tracks->error->p50, kMostPixels);
  }
  if (GetParam().format == SequenceFormat::kStir) CheckStirFiles();
  if (GetParam().format == SequenceFormat::kSurgT) CheckSurgTFiles();
  if (GetParam().format == SequenceFormat::kStir) {
    ASSERT_TRUE(figures.end_points.has_value());
    EXPECT_GT(figures.end_points->followed, 3);
    ASSERT_TRUE(figures.end_points->error.has_value());
    EXPECT_LT(figures.end_points->error->p50, kMostPixels);
    EXPECT_GT(figures.end_points->within[1], 0.8);
  }
}

constexpr double kStereoError = 1e-3;
// Depth in millimetres, with noise.
constexpr double kDepthError = 0.6e-3;

INSTANTIATE_TEST_SUITE_P(
    All,
    Layouts,
    ::testing::Values(LayoutCase{SequenceFormat::kNative, false, 0, kDepthError},
                      LayoutCase{SequenceFormat::kNativeStereo, true, 0, kStereoError},
                      LayoutCase{SequenceFormat::kStereoMis, true, 1, kStereoError},
                      LayoutCase{SequenceFormat::kScared, true, 0, kStereoError},
                      LayoutCase{SequenceFormat::kSurgT, true, 0, kStereoError},
                      LayoutCase{SequenceFormat::kStir, true, 0, kStereoError},
                      LayoutCase{SequenceFormat::kHamlynStereo, true, 0, kStereoError},
                      LayoutCase{SequenceFormat::kServCt, true, 1, kDepthError},
                      LayoutCase{SequenceFormat::kD4d, true, 0, kDepthError},
                      LayoutCase{SequenceFormat::kEndoNerf, false, 0, kDepthError},
                      LayoutCase{SequenceFormat::kDeform3dgs, false, 0, kDepthError},
                      LayoutCase{SequenceFormat::kC3vd, false, 0, kDepthError},
                      LayoutCase{SequenceFormat::kDeepDeform, false, 0, kDepthError},
                      LayoutCase{SequenceFormat::kSuper, false, 0, kDepthError},
                      LayoutCase{SequenceFormat::kSevenScenes, false, 0, kDepthError}),
    [](const auto& info) { return NameOf(info.param.format); });

}  // namespace
}  // namespace ceres_ed
