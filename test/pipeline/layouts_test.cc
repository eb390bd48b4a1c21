// Every layout that can be written: simulate, write, read, track, evaluate.
#include "../io/io_test_util.h"

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/evaluate/evaluate_run.h>
#include <ceres_ed/pipeline/simulate/simulate_run.h>
#include <ceres_ed/pipeline/slam/slam_run.h>

#include <ostream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  Evaluate();
  const SequenceFigures& figures = observer_.figures();
  ASSERT_EQ(figures.truth.size(), 3U);
  for (const FrameTruthError& error : figures.truth) {
    ASSERT_TRUE(error.tracking_seen.has_value());
    EXPECT_LT(error.tracking_seen->p50, GetParam().max_error) << "frame " << error.frame;
  }
  // The camera of the truth is known in all layouts that are written here.
  EXPECT_TRUE(figures.camera.has_value());
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
