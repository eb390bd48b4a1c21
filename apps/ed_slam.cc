// ed_slam tracks the camera and the tissue that it sees, frame by frame.
#include <ceres_ed/pipeline/slam/slam_run.h>
#include <ceres_ed/util/timer.h>

#include <cstdio>
#include <string>
#include <vector>

#include <apps/slam_flags.h>
#include <apps/slam_text.h>
#include <apps/support/console.h>
#include <apps/support/program.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

// Shows each frame in the way that --progress asks for.
class SlamConsole : public ConsoleObserver<SlamObserver> {
 public:
  SlamConsole(ProgressStyle style, bool quiet) : ConsoleObserver("ed_slam", quiet), style_(style) {}

  void OnFrame(const FrameRecord& record, int done, int total, double frames_per_s) override {
    if (style_ == ProgressStyle::kBar) {
      console().ShowProgress(done, total, ProgressNote(record, frames_per_s));
    }
    if (style_ == ProgressStyle::kJson) {
      std::fputs(ProgressJson(record, done, total, frames_per_s).c_str(), stdout);
      std::fflush(stdout);
    }
  }

  void OnEnd(const SlamRun& run) override {
    if (run.status != "failed" && style_ != ProgressStyle::kJson) {
      console().Summarize(SlamSummary(run));
    }
  }

 private:
  ProgressStyle style_;
};

Outcome Run(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  StatusOr<SlamCommand> command = ReadSlamFlags();
  if (!command.ok()) return Outcome::Usage(command.status().message());
  command->input = arguments[0];
  command->flags = CurrentFlags();
  command->fixed_flags = FixedFlags();
  command->strategy_flags = StrategyFlags();
  SlamConsole console(command->progress, command->quiet);
  return RunSlam(*command, clock, &console);
}

const ProgramInfo kProgram = {
    "ed_slam",
    "SEQUENCE_DIR --output=DIR",
    "Tracks a deforming scene in depth frames or stereo pictures and maps it. Writes report.json, "
    "frames.csv, "
    "trajectory.txt, map.ply, graph.ply, tracks.csv and live/NNNNNN.ply to DIR, in metres and "
    "seconds. t_total of a frame does not include reading and decoding (t_load) and writing "
    "(t_write). Ctrl-C ends the run after the current frame.",
    "ed_slam sequences/liver --output=out --track=landmarks.ply",
    1,
    1};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
