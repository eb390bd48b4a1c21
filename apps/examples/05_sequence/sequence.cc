// Tracks the camera and the tissue of a depth sequence, and writes the map. This is the core of
// ed_slam.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/slam/map_export.h>
#include <ceres_ed/slam/slam.h>

#include <cstdio>
#include <memory>
#include <string>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a program, not a header

namespace {

int Fail(const Status& status) {
  std::fprintf(stderr, "%s\n", status.message().c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {  // sequence FOLDER MAP.ply
  if (argc != 3) return 1;
  const StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(argv[1]);
  if (!sequence.ok()) return Fail(sequence.status());

  const EnergyRegistry registry = BuiltinEnergies();
  const StatusOr<std::unique_ptr<DeformableSlam>> slam =
      DeformableSlam::Create((*sequence)->camera(), SlamOptions(), registry);
  if (!slam.ok()) return Fail(slam.status());

  int tracked = 0;
  for (int i = 0; i < (*sequence)->num_frames(); ++i) {
    const StatusOr<DepthFrame> picture = (*sequence)->Load(i);
    if (!picture.ok()) continue;  // a damaged frame is skipped
    SlamFrame frame;
    frame.number = picture->number;
    frame.depth = &picture->depth;
    frame.color = &picture->color;
    const FrameReport report = (*slam)->Process(frame);
    std::printf("frame %d: %s, %d nodes, %d of %d points seen\n",
                report.number,
                NameOf(report.status).c_str(),
                report.nodes,
                report.points,
                report.map_points);
    if (report.status == FrameStatus::kTracked) ++tracked;
  }

  (*slam)->CatchUp();  // moves hidden nodes that have not been moved yet
  const Status saved = WriteMapCloud(argv[2], ExportMap(**slam));
  if (!saved.ok()) return Fail(saved);
  return tracked + 1 == (*sequence)->num_frames() ? 0 : 1;
}
