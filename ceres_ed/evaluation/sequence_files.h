// The files that the evaluation of a sequence reads: the pictures and truth of the sequence, and
// the results of a run.
#ifndef CERES_ED_EVALUATION_SEQUENCE_FILES_H_
#define CERES_ED_EVALUATION_SEQUENCE_FILES_H_

#include <ceres_ed/evaluation/scan_truth.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/io/sequence/layouts/stir_truth.h>
#include <ceres_ed/io/sequence/picture_tracks.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// A sequence of any layout with its truth. The files of truth have the same names in every layout
// (poses.txt, gt_vertices.f32, gt_mesh_000000.ply, tracks_2d.csv) and number the frames like the
// layout. Poses that belong to the layout itself are truth, too.
struct SequenceFiles {
  // The camera of the depth: of a stereo sequence, the rectified left one.
  PinholeCamera camera;
  // All pictures, without colours and masks; null if the folder contains camera.txt and poses.txt
  // but no depth.
  std::unique_ptr<DepthSource> pictures;
  // The index of the picture of each frame.
  std::map<int, int> index_of_frame;
  // The true camera poses by frame; empty if they are not known.
  std::map<int, CameraPose> true_poses;
  std::optional<SceneTruth> truth;
  // tracks_2d.csv, or what the layout has instead (layout_truth.h).
  std::vector<TrackObservation> tracks;
  // The points of STIR at start and end.
  std::optional<StirPoints> end_points;
  // The scans of D4D by frame.
  std::map<int, ScanPoints> scans;
  // Sentences about truth that could not be read.
  std::vector<std::string> warnings;

  // Returns whether the sequence contains the frame: its picture, or its pose if there are no
  // pictures.
  bool HasFrame(int frame) const;
  // Returns the frame of each time.
  std::map<double, int> FramesByTime() const;
  // Returns the depth of a frame, or nothing if there is none or it cannot be read. In the second
  // case a sentence is added to `warnings`, because a sequence may contain a bad frame. It is an
  // error if a picture has another size than the camera.
  StatusOr<std::optional<DepthImage>> LoadDepth(int frame,
                                                std::vector<std::string>* warnings) const;
};

// Returns the sequence in `folder`. It is an error, which names the file, if OpenSequence() fails,
// if a file of truth cannot be read, if there is a true mesh without poses, or if there are neither
// depth images nor poses.
StatusOr<SequenceFiles> OpenSequenceFiles(const std::string& folder);

// The results of a run, except for the live clouds, which are read one by one.
struct ResultFiles {
  // The paths live/NNNNNN.ply by frame, at least one. Each frame belongs to the sequence.
  std::map<int, std::string> live_paths;
  // The poses world_from_camera of trajectory.txt, by frame.
  std::map<int, CameraPose> trajectory;
  // The log frames.csv, if there is one.
  std::optional<FrameLog> log;
  // Warnings of one sentence each.
  std::vector<std::string> warnings;
};

// Returns the files of the result in `folder` for the sequence in `sequence_folder`. It is an
// error, which names the file, if there are no live clouds, if one belongs to a frame that the
// sequence lacks, or if a file cannot be read.
StatusOr<ResultFiles> LoadResultFiles(const std::string& folder,
                                      const std::string& sequence_folder,
                                      const SequenceFiles& sequence);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SEQUENCE_FILES_H_
