// ed_simulate makes depth sequences of deforming tissue, with truth.
#include <apps/simulate_run.h>
#include <apps/support/program.h>

namespace {

const ceres_ed::ProgramInfo kProgram = {
    "ed_simulate",
    "SCENE --output=DIR [flags]",
    "Makes a sequence of depth and colour pictures of deforming tissue, in the layout that ed_slam "
    "reads, or of stereo pictures (--stereo), with the truth: camera poses, and every vertex of "
    "the tissue in every frame. SCENE is "
    "strip (a camera moves along a band of any length and always sees a part of the same size), "
    "heart, kidney or stomach (a camera circles an organ of 10 cm that deforms and returns to its "
    "shape), or plane (a sheet of 20 cm is warped under a still camera, which sees half of it from "
    "the second frame on). The same flags give the same bytes.",
    "ed_simulate heart --output=heart --frames=60",
    1,
    1};

}  // namespace

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(kProgram, argc, argv, ceres_ed::RunSimulate);
}
