// frames.csv: one row for each frame that a tracker has taken in.
#ifndef CERES_ED_IO_RESULTS_FRAMES_CSV_H_
#define CERES_ED_IO_RESULTS_FRAMES_CSV_H_

#include <ceres_ed/util/status.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// The columns behind frame and status; scripts rely on the names and, up to energy, on their order.
// Seconds, metres, counts. t_total is the whole frame but t_load (reading and decoding, as far as
// it wasn't done during the frame before) and t_write. NaN, an empty cell, stands for a value that
// is not known of this frame.
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
  // What became of the frame: "tracked", "lost" and so on.
  std::string status = "skipped";
  // In the order of kFrameColumns.
  std::array<double, kFrameColumns.size()> values = {};

  // The value of a column that is there.
  double& operator[](const std::string& column);
  double operator[](const std::string& column) const {
    return const_cast<FrameRecord&>(*this)[column];
  }
};

// Return the first line of frames.csv and a row of it, with their line ends.
std::string FramesHeader();
std::string FramesRow(const FrameRecord& record);

// A whole frames.csv, by columns.
struct FrameLog {
  std::vector<int> frames;
  std::vector<std::string> statuses;
  // All other columns in the order of the file: name and one value a frame, NaN where the file has
  // none.
  std::vector<std::pair<std::string, std::vector<double>>> columns;

  // The column of that name, or null.
  const std::vector<double>* Find(const std::string& name) const;
};

// Returns the log of a run: a header with at least `frame` and `status`, then a row a frame; other
// columns may be any. Errors name file, line, value and what was expected.
StatusOr<FrameLog> ReadFrameLog(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_FRAMES_CSV_H_
