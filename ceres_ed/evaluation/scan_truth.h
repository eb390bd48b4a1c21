// Scans of the tissue that D4D has of the start and of the end of a clip.
#ifndef CERES_ED_EVALUATION_SCAN_TRUTH_H_
#define CERES_ED_EVALUATION_SCAN_TRUTH_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The points of a scan in the camera frame of a frame, in metres.
using ScanPoints = std::vector<Eigen::Vector3d>;

// Reads the scans of a clip of D4D: clips.json of the session, two folders above, names them
// (start_geometry, end_geometry), and curated_camera_pose_start.txt and _end.txt of the clip place
// the camera in them. They belong to the frames `first` and `last`. A scan whose points are farther
// than 5 from the camera in the median is in millimetres. There are none in other layouts. Errors
// name the file.
StatusOr<std::map<int, ScanPoints>> ReadScans(const std::string& folder, int first, int last);

// How far a map is from a scan in a frame.
struct ScanAgreement {
  int frame = 0;
  // The number of map points in the picture that are not behind the map.
  int seen = 0;
  // Their distances to the nearest points of the scan, in metres; nothing if no point is seen.
  std::optional<DistanceStatistics> distance;
};

// Returns how far the map points that the camera sees are from `scan`, which is not empty.
ScanAgreement CompareWithScan(const PinholeCamera& camera,
                              const LiveSnapshot& snapshot,
                              const ScanPoints& scan,
                              const SequenceEvaluationOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_SCAN_TRUTH_H_
