#include "apps/slam_frames.h"

#include <ceres_ed/io/text_rows.h>

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {

double& FrameRecord::operator[](const std::string& column) {
  const auto found = std::find(kFrameColumns.begin(), kFrameColumns.end(), column);
  CHECK(found != kFrameColumns.end()) << "no column " << column;
  return values[static_cast<std::size_t>(found - kFrameColumns.begin())];
}

FrameRecord MakeFrameRecord(const FrameReport& report, const DeformableSlam& slam) {
  FrameRecord record;
  record.number = report.number;
  record.status = report.status;
  const FrameTimes& times = report.times;
  record["t_associate"] = times.associate;
  record["t_camera"] = times.camera;
  record["t_level1"] = times.level1;
  record["t_level2"] = times.level2;
  record["t_warp"] = times.warp;
  record["t_grow"] = times.grow;
  record["t_observe"] = times.observe;
  record["t_features"] = times.features;
  // Of frames that are lost, too: the map is still there.
  record["nodes"] = slam.map().graph().num_nodes();
  record["map_points"] = slam.map().num_points();
  record["pr"] = report.point_relevant;
  record["active"] = report.active;
  record["updated_pi"] = report.updated_pi;
  record["points"] = report.points;
  record["inliers"] = report.inliers;
  record["rms_plane"] = report.rms_plane;
  record["energy"] = report.energy;
  record["features"] = report.features;
  record["iterations"] = report.iterations;
  return record;
}

bool HasPose(FrameStatus status) {
  return status != FrameStatus::kLost && status != FrameStatus::kSkipped;
}

std::string FramesHeader() {
  std::string header = "frame,status";
  for (const char* column : kFrameColumns) header += std::string(",") + column;
  return header + "\n";
}

std::string FramesRow(const FrameRecord& record) {
  std::string row = std::to_string(record.number) + "," + FrameStatusName(record.status);
  for (std::size_t i = 0; i < kFrameColumns.size(); ++i) {
    const bool is_time = kFrameColumns[i][0] == 't' && kFrameColumns[i][1] == '_';
    // Clocks know no more than microseconds.
    const double value = is_time ? std::round(record.values[i] * 1e6) / 1e6 : record.values[i];
    std::string text;
    AppendNumbers({value}, &text);
    row += "," + text;
  }
  return row + "\n";
}

void ExchangeRecords(std::vector<FrameRecord>* records, CheckpointArchive* archive) {
  archive->Enter("frames");
  std::vector<int> statuses;
  for (const FrameRecord& record : *records) statuses.push_back(static_cast<int>(record.status));
  archive->Array("status", &statuses);
  if (!archive->saving()) records->assign(statuses.size(), FrameRecord());
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    (*records)[i].status = static_cast<FrameStatus>(statuses[i]);
  }
  archive->Column("number", records, [](FrameRecord& r) -> int& { return r.number; });
  archive->Column(
      "values", records, [](FrameRecord & r) -> auto& { return r.values; });
  archive->Leave();
}

}  // namespace ceres_ed
