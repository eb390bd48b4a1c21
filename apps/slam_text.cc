#include "apps/slam_text.h"

#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/pipeline/slam/slam_verdict.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

template <typename... Arguments>
std::string Line(const char* format, Arguments... arguments) {
  char text[256];
  std::snprintf(text, sizeof(text), format, arguments...);
  return text;
}

}  // namespace

std::string SlamSummary(const SlamRun& run) {
  const std::vector<FrameRecord>& records = *run.records;
  const DeformableSlam& slam = *run.slam;
  const double median_s = InterpolatedMedian(ColumnOf(records, "t_total"));
  return Line("status     %s: %s\n", run.status.c_str(), run.message.c_str()) +
         Line("frames     %zu: %d initialized, %d tracked, %d relocalized, %d lost, %d skipped\n",
              records.size(),
              CountFrames(records, FrameStatus::kInitialized),
              CountFrames(records, FrameStatus::kTracked),
              CountFrames(records, FrameStatus::kRelocalized),
              CountFrames(records, FrameStatus::kLost),
              CountFrames(records, FrameStatus::kSkipped)) +
         Line("map        %d points, %d nodes %.3g mm apart\n",
              slam.map().num_points(),
              slam.map().graph().num_nodes(),
              1e3 * slam.unit()) +
         Line("rms        %.3g mm to planes (median of the frames)\n",
              1e3 * InterpolatedMedian(ColumnOf(records, "rms_plane"))) +
         Line("time       %.2f s, %.1f ms a frame (median)\n", run.total_s, 1e3 * median_s) +
         "output     " + run.settings->output + "\n" + "verdict    " +
         JudgeRun(records, slam.unit()).Sentence() + "\n";
}

std::string ProgressJson(const FrameRecord& record, int done, int total, double frames_per_s) {
  ordered_json line = {{"frame", record.number}, {"status", record.status}};
  for (std::size_t i = 0; i < kFrameColumns.size(); ++i) line[kFrameColumns[i]] = record.values[i];
  line["done"] = done;
  line["total"] = total;
  line["frames_per_s"] = frames_per_s;
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string ProgressNote(const FrameRecord& record, double frames_per_s) {
  return Line("%s, %.1f frames/s, %.0f nodes, rms %.3g mm",
              record.status.c_str(),
              frames_per_s,
              record["nodes"],
              1e3 * record["rms_plane"]);
}

}  // namespace ceres_ed
