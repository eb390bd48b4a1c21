// ed_fit: one surface deformed until it lies on another, or its landmarks where they belong.
#include <apps/fit_run.h>
#include <apps/support/program.h>

namespace {

const ceres_ed::ProgramInfo kProgram = {
    "ed_fit",
    "SOURCE.ply [TARGET.ply] --output=OUT.ply",
    "Deforms SOURCE until it lies on TARGET, or, without one, until its --landmarks are where they "
    "belong. Meshes or bare points, in the same unit.",
    "ed_fit source.ply target.ply --output=fitted.ply --warp=warp.json --report=report.json",
    1,
    2};

}  // namespace

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(kProgram, argc, argv, ceres_ed::RunFit);
}
