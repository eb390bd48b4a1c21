// What frames.csv says of a frame.
#ifndef CERES_ED_APPS_SLAM_FRAMES_H_
#define CERES_ED_APPS_SLAM_FRAMES_H_

#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace ceres_ed {

// Columns behind frame and status; scripts rely on the names and, up to energy, on their order.
// Seconds, metres, counts; t_total is all of a frame but t_load (reading and decoding, as far as
// that wasn't done while the frame before was taken in) and t_write. Not a number, an empty cell:
// not known of this frame.
inline constexpr std::array<const char*, 30> kFrameColumns = {
    "t_total",         "t_load",
    "t_associate",     "t_camera",
    "t_level1",        "t_level2",
    "t_warp",          "t_grow",
    "nodes",           "pr",
    "active",          "updated_pi",
    "points",          "map_points",
    "inliers",         "rms_plane",
    "energy",          "t_observe",
    "t_features",      "t_write",
    "features",        "iterations",
    "verify_energy",   "verify_batch_energy",
    "verify_gap",      "verify_node_mean",
    "verify_node_max", "verify_camera_deg",
    "verify_camera_m", "t_verify"};

// One row.
struct FrameRecord {
  int number = 0;
  FrameStatus status = FrameStatus::kSkipped;
  // As kFrameColumns.
  std::array<double, kFrameColumns.size()> values = {};

  // The value of a column that is there.
  double& operator[](const std::string& column);
  double operator[](const std::string& column) const {
    return const_cast<FrameRecord&>(*this)[column];
  }
};

// Returns the row of a frame that `slam` has taken in; t_total, t_load and t_write are left 0.
FrameRecord MakeFrameRecord(const FrameReport& report, const DeformableSlam& slam);

// Whether camera and tissue are known in such a frame.
bool HasPose(FrameStatus status);

// Return the first line of frames.csv and a row of it, with their ends.
std::string FramesHeader();
std::string FramesRow(const FrameRecord& record);

// Saves rows, or loads them.
void ExchangeRecords(std::vector<FrameRecord>* records, CheckpointArchive* archive);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_FRAMES_H_
