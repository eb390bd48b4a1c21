// What ed_eval reads of a folder that ed_slam wrote.
#ifndef CERES_ED_APPS_EVAL_RESULT_FILES_H_
#define CERES_ED_APPS_EVAL_RESULT_FILES_H_

#include <ceres_ed/evaluation/live_snapshot.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <apps/eval_sequence_files.h>
#include <apps/eval_table_file.h>

namespace ceres_ed {

// Everything but the live clouds, which are read one by one.
struct ResultFiles {
  // live/NNNNNN.ply by frame, at least one; each frame is one of the sequence.
  std::map<int, std::string> live_paths;
  // Of trajectory.txt, whose times are frame numbers in the native layout; world_from_camera.
  std::map<int, CameraPose> trajectory;
  // Of frames.csv.
  std::optional<FrameLog> log;
  // One sentence each.
  std::vector<std::string> warnings;
};

// Returns what there is of the result in `folder` of the sequence in `sequence_folder`. Errors name
// the file: no live clouds, one of a frame that the sequence lacks, a file that can't be read.
StatusOr<ResultFiles> LoadResultFiles(const std::string& folder,
                                      const std::string& sequence_folder,
                                      const SequenceFiles& sequence);

// Returns the live cloud `path` of `frame`. Errors name the file: as of LoadCloud, a property of
// `id birth_frame bx by bz` that is missing or of the wrong kind, an id that is there twice. Points
// that are not finite are left out, with a sentence in `warnings`.
StatusOr<LiveSnapshot> LoadLiveSnapshot(const std::string& path,
                                        int frame,
                                        std::vector<std::string>* warnings);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_RESULT_FILES_H_
