// frames.csv: one row for each frame that a tracker has processed.
#ifndef CERES_ED_IO_RESULTS_FRAMES_CSV_H_
#define CERES_ED_IO_RESULTS_FRAMES_CSV_H_

#include <ceres_ed/util/status.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// The columns after frame and status. Scripts rely on their names and, up to energy, on their
// order. Units are seconds, metres and counts. t_total is the time of the whole frame without
// t_load (reading and decoding, except for the part that was done during the previous frame) and
// t_write. t_stereo is the time of comparing stereo pictures, which may be done during the previous
// frame, and valid_share the share of their pixels whose depth was found. NaN, which is an empty
// cell, means that a value is not known for this frame.
inline constexpr std::array<const char*, 38> kFrameColumns = {
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
    "verify_camera_m", "t_verify",
    "explained",       "overlap",
    "weak_directions", "tentative",
    "foreground",      "t_stereo",
    "valid_share",     "held_share"};

// One row.
struct FrameRecord {
  int number = 0;
  // The outcome of the frame: "tracked", "lost" and so on.
  std::string status = "skipped";
  // In the order of kFrameColumns.
  std::array<double, kFrameColumns.size()> values = {};

  // Returns the value of a column, which must exist.
  double& operator[](const std::string& column);
  double operator[](const std::string& column) const {
    return const_cast<FrameRecord&>(*this)[column];
  }
};

// The following two functions return the first line of frames.csv and a row of it, with line ends.
std::string FramesHeader();
std::string FramesRow(const FrameRecord& record);

// The contents of a frames.csv, by columns.
struct FrameLog {
  std::vector<int> frames;
  std::vector<std::string> statuses;
  // All other columns in the order of the file: the name, and one value for each frame. A value is
  // NaN if the file has none.
  std::vector<std::pair<std::string, std::vector<double>>> columns;

  // Returns the column of that name, or null.
  const std::vector<double>* Find(const std::string& name) const;
};

// Reads the log of a run: a header with at least `frame` and `status`, then a row for each frame.
// Other columns are optional. Errors name file, line, value and what was expected.
StatusOr<FrameLog> ReadFrameLog(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_FRAMES_CSV_H_
