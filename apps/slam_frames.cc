#include "apps/slam_frames.h"

#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
  record["updated_pi"] = report.marginalized + report.updated_pi;
  record["points"] = report.points;
  record["inliers"] = report.inliers;
  record["rms_plane"] = report.rms_plane;
  record["energy"] = report.energy;
  record["features"] = report.features;
  record["iterations"] = report.iterations;
  const BatchComparison& batch = report.batch;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  record["verify_energy"] = batch.done ? batch.energy : nothing;
  record["verify_batch_energy"] = batch.done ? batch.batch_energy : nothing;
  record["verify_gap"] = batch.done ? batch.Gap() : nothing;
  record["verify_node_mean"] = batch.done ? batch.node_mean * slam.unit() : nothing;
  record["verify_node_max"] = batch.done ? batch.node_max * slam.unit() : nothing;
  record["verify_camera_deg"] = batch.done ? batch.camera_deg : nothing;
  record["verify_camera_m"] = batch.done ? batch.camera_distance * slam.unit() : nothing;
  record["t_verify"] = times.verify;
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
    if (!std::isnan(value)) AppendNumbers({value}, &text);
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
