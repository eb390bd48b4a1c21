// The files that the evaluation of a sequence reads: its pictures and truth, and what a run has
// left.
#ifndef CERES_ED_EVALUATION_SEQUENCE_FILES_H_
#define CERES_ED_EVALUATION_SEQUENCE_FILES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/io/sequence/picture_tracks.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// A sequence of any layout with its truth. The files of truth have the same names in every layout
// (poses.txt, gt_vertices.f32, gt_mesh_000000.ply, tracks_2d.csv) and count frames as the layout
// does; poses that the layout itself gives are truth, too.
struct SequenceFiles {
  PinholeCamera camera;
  // All of the frames, without colours and masks; null where a folder has camera.txt and poses.txt
  // and no depth.
  std::unique_ptr<DepthSequence> pictures;
  // Which of the pictures belongs to a frame.
  std::map<int, int> index_of_frame;
  // Empty where the camera is not known.
  std::map<int, CameraPose> true_poses;
  std::optional<SceneTruth> truth;
  std::vector<TrackObservation> tracks;

  // Whether the sequence has the frame: a picture of it, or its pose where there are no pictures.
  bool HasFrame(int frame) const;
  // The frame of each time.
  std::map<double, int> FramesByTime() const;
  // Returns the depth of a frame, or nothing where there is none or it can't be read, with a
  // sentence in `warnings`: a sequence may have a bad frame in the middle. Error: a picture of
  // another size than the camera's.
  StatusOr<std::optional<DepthImage>> LoadDepth(int frame,
                                                std::vector<std::string>* warnings) const;
};

// Returns the sequence in `folder`. Errors name the file: as of OpenSequence, a file of truth that
// can't be read, the truth of a mesh without poses, neither depth images nor poses.
StatusOr<SequenceFiles> OpenSequenceFiles(const std::string& folder);

// What a run has left, but for the live clouds, which are read one by one.
struct ResultFiles {
  // live/NNNNNN.ply by frame, at least one; each frame is one of the sequence.
  std::map<int, std::string> live_paths;
  // Of trajectory.txt; world_from_camera.
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

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SEQUENCE_FILES_H_
