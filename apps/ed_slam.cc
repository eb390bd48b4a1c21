// ed_slam: the camera and the tissue that it looks at, frame by frame.
#include <apps/slam_run.h>
#include <apps/support/program.h>

namespace {

const ceres_ed::ProgramInfo kProgram = {
    "ed_slam",
    "SEQUENCE_DIR --output=DIR",
    "Tracks a deforming scene in depth frames and maps it. Writes to DIR: report.json, frames.csv, "
    "trajectory.txt, map.ply, graph.ply, tracks.csv and live/NNNNNN.ply; metres and seconds, and "
    "t_total of a frame is all but reading and decoding (t_load) and writing (t_write). Ctrl-C "
    "ends it after the frame at hand.",
    "ed_slam sequences/liver --output=out --track=landmarks.ply",
    1,
    1};

}  // namespace

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(kProgram, argc, argv, ceres_ed::RunSlam);
}
