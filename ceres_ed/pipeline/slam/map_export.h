// Exports the map of a tracker in metres, for files and for users of the library.
#ifndef CERES_ED_PIPELINE_SLAM_MAP_EXPORT_H_
#define CERES_ED_PIPELINE_SLAM_MAP_EXPORT_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/results/covariance_files.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/slam/slam.h>

#include <vector>

namespace ceres_ed {

// The coordinate frame of an exported map.
enum class MapFrame {
  // The frame of the first camera.
  kMap,
  // The frame of the camera after the last processed image.
  kCamera,
};

// These functions export the map as it is. Call DeformableSlam::CatchUp() first if the whole map
// must be up to date.

// Returns all points in their current positions, as the nodes deform them.
MapSnapshot ExportMap(const DeformableSlam& slam, MapFrame frame = MapFrame::kMap);

// Returns the covariance of each point in the map frame (DeformableSlam::PointCovariance).
MapCovariances ExportMapCovariances(const DeformableSlam& slam);

// Returns all points in the camera frame, with the positions at which they were created, for live
// clouds.
std::vector<LivePoint> ExportLivePoints(const DeformableSlam& slam);

// Returns the warp from the rest shape of the tissue to its current shape, in the map frame.
Warp ExportWarp(const DeformableSlam& slam);

// Returns map_from_camera after the last frame. The result is meaningless before the first frame.
CameraPose ExportCameraPose(const DeformableSlam& slam);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_MAP_EXPORT_H_
