// What ed_eval reads of a sequence in the native layout.
#ifndef CERES_ED_APPS_EVAL_SEQUENCE_FILES_H_
#define CERES_ED_APPS_EVAL_SEQUENCE_FILES_H_

#include <ceres_ed/evaluation/scene_truth.h>
#include <ceres_ed/evaluation/track_following.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// Everything but the pictures.
struct SequenceFiles {
  CameraFile camera;
  // depth/NNNNNN.png by frame.
  std::map<int, std::string> depth_paths;
  // Of poses.txt; empty where there is none.
  std::map<int, CameraPose> true_poses;
  // Of gt_vertices.f32 and gt_mesh_000000.ply.
  std::optional<SceneTruth> truth;
  // Of tracks_2d.csv.
  std::vector<TrackObservation> tracks;

  bool HasFrame(int frame) const;
};

// Returns the files of `folder` whose names are a number and end in `extension` (".ply"), by that
// number; none where there is no such folder. Error: two files have one number.
StatusOr<std::map<int, std::string>> NumberedFiles(const std::string& folder,
                                                   const std::string& extension);

// Returns the sequence in `folder`: camera.txt, and what there is of the rest. Errors name the
// file: one that can't be read, the truth of a mesh without poses, vertices or triangles, or of
// another size than frames x vertices x 3, neither depth images nor poses.
StatusOr<SequenceFiles> LoadSequenceFiles(const std::string& folder);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_SEQUENCE_FILES_H_
