// Fits two clouds, saves the deformation, and applies it to another cloud, as ed_fit and ed_apply
// do.
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/registration/fit.h>

#include <cstdio>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a program, not a header

namespace {

int Fail(const Status& status) {
  std::fprintf(stderr, "%s\n", status.message().c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {  // first_fit SOURCE.ply TARGET.ply OTHER.ply WARP.json OUT.ply
  if (argc != 6) return 1;
  const StatusOr<LoadedCloud> source = LoadCloud(argv[1]);
  if (!source.ok()) return Fail(source.status());
  const StatusOr<LoadedCloud> target = LoadCloud(argv[2]);
  if (!target.ok()) return Fail(target.status());

  const StatusOr<FitResult> fit = Fit(source->cloud, target->cloud);
  if (!fit.ok()) return Fail(fit.status());  // an input that can't be used
  if (!fit->IsUsable()) return 3;            // a solve that failed; fit->message says why
  for (const std::string& warning : fit->warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  std::printf("%d nodes, %.2g to the planes of the target\n",
              fit->warp.graph.num_nodes(),
              fit->matches.rms_plane);

  // The deformation can be saved to a file and read again, also by another program.
  if (const Status status = WriteWarp(argv[4], fit->warp); !status.ok()) return Fail(status);
  const StatusOr<Warp> warp = ReadWarp(argv[4]);
  if (!warp.ok()) return Fail(warp.status());

  // It deforms any other cloud in the frame of the source.
  StatusOr<LoadedCloud> other = LoadCloud(argv[3]);
  if (!other.ok()) return Fail(other.status());
  if (const Status status = ApplyWarp(*warp, &other->cloud); !status.ok()) return Fail(status);
  const Status saved = SaveCloud(argv[5], *other, other->cloud.points, nullptr);
  return saved.ok() ? 0 : Fail(saved);
}
