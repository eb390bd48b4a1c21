// ed_depth finds the depth of stereo pictures.
#include <apps/depth_run.h>
#include <apps/support/program.h>

namespace {

const ceres_ed::ProgramInfo kProgram = {
    "ed_depth",
    "SEQUENCE --output=DIR [flags]",
    "Finds the depth of the pictures of a stereo camera and writes a depth sequence in the native "
    "layout: depth/, color/, camera.txt, and mask/, poses.txt and truth if the sequence has them. "
    "The camera is the rectified left one. ed_slam does the same while it tracks, and needs no "
    "ed_depth. Pixels without a match, in highlights, or at infinity have depth 0.",
    "ed_depth recordings/heart --output=heart_depth --reduce=2",
    1,
    1};

}  // namespace

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(kProgram, argc, argv, ceres_ed::RunDepthProgram);
}
