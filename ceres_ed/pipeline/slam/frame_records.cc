#include "ceres_ed/pipeline/slam/frame_records.h"

#include <ceres_ed/slam/map/deformable_map.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace ceres_ed {
namespace {

constexpr FrameStatus kStatuses[] = {FrameStatus::kTracked,
                                     FrameStatus::kInitialized,
                                     FrameStatus::kRelocalized,
                                     FrameStatus::kLost,
                                     FrameStatus::kSkipped};

// Returns the number of the status in checkpoints.
int NumberOf(const FrameRecord& record) {
  for (const FrameStatus status : kStatuses) {
    if (Is(record, status)) return static_cast<int>(status);
  }
  return static_cast<int>(FrameStatus::kSkipped);
}

}  // namespace

FrameRecord MakeFrameRecord(const FrameReport& report, const DeformableSlam& slam) {
  FrameRecord record;
  record.number = report.number;
  record.status = NameOf(report.status);
  const FrameTimes& times = report.times;
  record["t_associate"] = times.associate;
  record["t_camera"] = times.camera;
  record["t_level1"] = times.level1;
  record["t_level2"] = times.level2;
  record["t_warp"] = times.warp;
  record["t_grow"] = times.grow;
  record["t_observe"] = times.observe;
  record["t_features"] = times.features;
  // Lost frames have these, too, because the map is still there.
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
  record["explained"] = report.explained;
  record["overlap"] = report.overlap;
  record["weak_directions"] = report.weak_directions;
  record["tentative"] = report.tentative;
  record["foreground"] = report.foreground;
  record["held_share"] = report.held_share;
  return record;
}

bool Is(const FrameRecord& record, FrameStatus status) { return record.status == NameOf(status); }

bool HasPose(const FrameRecord& record) {
  return !Is(record, FrameStatus::kLost) && !Is(record, FrameStatus::kSkipped);
}

int CountFrames(const std::vector<FrameRecord>& records, FrameStatus status) {
  return static_cast<int>(std::count_if(
      records.begin(), records.end(), [status](const auto& r) { return Is(r, status); }));
}

std::vector<double> ColumnOf(const std::vector<FrameRecord>& records, const std::string& column) {
  std::vector<double> values;
  for (const FrameRecord& record : records) {
    if (HasPose(record)) values.push_back(record[column]);
  }
  return values;
}

void ExchangeRecords(std::vector<FrameRecord>* records, CheckpointArchive* archive) {
  archive->Enter("frames");
  std::vector<int> statuses;
  for (const FrameRecord& record : *records) statuses.push_back(NumberOf(record));
  archive->Array("status", &statuses);
  if (!archive->saving()) records->assign(statuses.size(), FrameRecord());
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    for (const FrameStatus status : kStatuses) {
      if (statuses[i] == static_cast<int>(status)) (*records)[i].status = NameOf(status);
    }
  }
  archive->Column("number", records, [](FrameRecord& r) -> int& { return r.number; });
  archive->Column(
      "values", records, [](FrameRecord & r) -> auto& { return r.values; });
  archive->Leave();
}

}  // namespace ceres_ed
