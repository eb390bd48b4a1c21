#include "apps/apply_landmarks.h"

#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/pipeline/apply/warped_points.h>

#include <apps/support/console.h>

namespace ceres_ed {

Outcome ApplyToLandmarks(const ApplySettings& settings,
                         const std::string& warp_path,
                         const Warp& warp,
                         const std::string& input,
                         const LoadedCloud* surface) {
  const StatusOr<LandmarkFile> landmarks = ReadLandmarkFile(input);
  if (!landmarks.ok()) return Outcome::BadInput(landmarks.status());
  const auto moved = WarpedLandmarks(warp, warp_path, surface, settings.mesh_space, *landmarks);
  if (!moved.ok()) return Outcome::BadInput(moved.status());
  const Status saved = WriteLandmarkFile(settings.output, *landmarks, *moved);
  if (!saved.ok()) return Outcome::BadInput(saved);

  Console console("ed_apply", /*quiet=*/false);
  for (const std::string& warning : landmarks->warnings) console.Warn(warning);
  if (surface == nullptr) {
    console.Warn(input +
                 ": the landmarks follow the nearest nodes; --source=SOURCE, the mesh of the fit, "
                 "would carry them on its surface");
  }
  console.Summarize(settings.output + ": " + std::to_string(moved->size()) +
                    " landmarks deformed by " + std::to_string(warp.graph.num_nodes()) +
                    " nodes\n");
  return Outcome::Done();
}

}  // namespace ceres_ed
