// The map of a tracker in metres: for files, and for whoever looks at it from outside.
#ifndef CERES_ED_PIPELINE_SLAM_MAP_EXPORT_H_
#define CERES_ED_PIPELINE_SLAM_MAP_EXPORT_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/slam/slam.h>

#include <vector>

namespace ceres_ed {

enum class MapFrame {
  // That of the first camera.
  kMap,
  // That of the camera after the last frame.
  kCamera,
};

// Each of these shows the map as it is: DeformableSlam::CatchUp() comes first where the whole of it
// matters.

// Returns all points as they are now, as the nodes deform them.
MapSnapshot ExportMap(const DeformableSlam& slam, MapFrame frame = MapFrame::kMap);

// Returns all points in the camera frame, with where they were born: for live clouds.
std::vector<LivePoint> ExportLivePoints(const DeformableSlam& slam);

// Returns the warp from where tissue is at rest to where it is now, map frame.
Warp ExportWarp(const DeformableSlam& slam);

// Returns map_from_camera after the last frame; of no meaning before the first one.
CameraPose ExportCameraPose(const DeformableSlam& slam);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_MAP_EXPORT_H_
