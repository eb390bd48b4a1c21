#include "ceres_ed/pipeline/slam/slam_report.h"

#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/pipeline/run_command.h>
#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/pipeline/slam/slam_verdict.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/util/statistics.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

double Mean(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

ordered_json Statistics(const std::vector<double>& values) {
  return {{"median", InterpolatedMedian(values)},
          {"mean", Mean(values)},
          {"max", values.empty() ? 0.0 : *std::max_element(values.begin(), values.end())}};
}

// Returns the peak memory of the process in MiB.
double PeakMemoryMib() {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Returns the present memory of the process in MiB; 0 if the system does not provide it.
double ResidentMemoryMib() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  if (!(file >> total >> resident)) return 0.0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

// Returns the memory of each part of the map in bytes, and that of the process in MiB.
ordered_json MemoryReport(const DeformableSlam& slam) {
  const MapMemory memory = slam.Memory();
  const auto per = [](std::size_t bytes, int count) {
    return static_cast<double>(bytes) / std::max(1, count);
  };
  return {{"map", memory.Total()},
          {"nodes", memory.nodes},
          {"edges", memory.edges},
          {"node_index", memory.node_index},
          {"tissue_memory", memory.tissue_memory},
          {"levels", memory.levels},
          {"points", memory.points},
          {"bindings", memory.bindings},
          {"point_lists", memory.point_lists},
          {"corners", memory.corners},
          {"per_node", per(memory.OfNodes(), slam.map().graph().num_nodes())},
          {"per_point", per(memory.OfPoints(), slam.map().num_points())},
          {"resident_mib", ResidentMemoryMib()}};
}

ordered_json SequenceReport(const SlamRun& run) {
  const DepthSource& sequence = *run.sequence;
  const PinholeCamera& camera = sequence.camera();
  ordered_json report = {{"path", run.settings->input},
                         {"description", sequence.description()},
                         {"frames", sequence.num_frames()},
                         {"first", sequence.frame_number(0)},
                         {"last", sequence.frame_number(sequence.num_frames() - 1)},
                         {"width", camera.width},
                         {"height", camera.height},
                         {"fx", camera.fx},
                         {"fy", camera.fy},
                         {"cx", camera.cx},
                         {"cy", camera.cy},
                         {"depth_units_per_metre", sequence.sequence().depth_units_per_metre()},
                         {"color", sequence.has_color()}};
  if (!sequence.is_stereo()) return report;
  // The camera above is the rectified left one, and its depth has no stored unit.
  report.erase("depth_units_per_metre");
  report["stereo"] = {{"rectified", sequence.sequence().is_rectified()},
                      {"baseline", sequence.rig()->baseline},
                      {"disparity_of_infinity", sequence.rig()->offset}};
  return report;
}

ordered_json FramesReport(const std::vector<FrameRecord>& records) {
  ordered_json report = {{"processed", records.size()}};
  for (const FrameStatus status : {FrameStatus::kInitialized,
                                   FrameStatus::kTracked,
                                   FrameStatus::kRelocalized,
                                   FrameStatus::kLost,
                                   FrameStatus::kSkipped}) {
    report[NameOf(status)] = CountFrames(records, status);
  }
  return report;
}

ordered_json NodesReport(const DeformableSlam& slam) {
  const int total = slam.map().graph().num_nodes();
  int pr = 0;
  for (int j = 0; j < total; ++j) pr += slam.HasData(j) ? 1 : 0;
  return {
      {"total", total}, {"pr", pr}, {"pi", total - pr}, {"edges", slam.map().graph().num_edges()}};
}

ordered_json TimeReport(const SlamRun& run) {
  ordered_json report = {{"total", run.total_s}};
  for (const char* column : kFrameColumns) {
    const std::string name = column;
    if (name == "t_stereo" && !run.sequence->is_stereo()) continue;
    if (name.rfind("t_", 0) == 0) report[name] = Statistics(ColumnOf(*run.records, name));
  }
  return report;
}

// Returns how long after its pictures were there the result of a frame was there. Pictures are read
// and compared beside the tracking of the frame before.
ordered_json LatencyReport(const SlamRun& run) {
  std::vector<double> latencies_ms;
  for (const FrameRecord& record : *run.records) {
    if (Is(record, FrameStatus::kSkipped)) continue;
    const double stereo_s = run.sequence->is_stereo() ? record["t_stereo"] : 0.0;
    const double latency_ms = 1e3 * (record["t_total"] + stereo_s);
    if (std::isfinite(latency_ms)) latencies_ms.push_back(latency_ms);
  }
  ordered_json report = ordered_json::object();
  for (const auto& [name, rank] :
       {std::pair("p50", 0.5), std::pair("p95", 0.95), std::pair("p99", 0.99)}) {
    report[name] = Percentile(latencies_ms, rank);
  }
  return report;
}

}  // namespace

ordered_json SlamReport(const SlamRun& run) {
  const SlamOptions& options = run.settings->options;
  const DeformableSlam& slam = *run.slam;
  return {{"program", "ed_slam"},
          {"version", kVersion},
          {"mode", NameOf(options.levels.strategy.mode)},
          {"camera", NameOf(options.camera)},
          {"status", run.status},
          {"message", run.message},
          {"sequence", SequenceReport(run)},
          {"verdict", VerdictReport(JudgeRun(*run.records, slam.unit()))},
          {"frames", FramesReport(*run.records)},
          {"nodes", NodesReport(slam)},
          {"map", {{"points", slam.map().num_points()}, {"node_spacing", slam.unit()}}},
          {"derived",
           {{"node_spacing", slam.unit()},
            {"point_spacing", options.growth.point_spacing * slam.unit()},
            {"features", options.features && run.sequence->has_color()}}},
          {"rms_plane", Statistics(ColumnOf(*run.records, "rms_plane"))},
          {"time_s", TimeReport(run)},
          {"latency_ms", LatencyReport(run)},
          {"memory_peak_mib", PeakMemoryMib()},
          {"memory", MemoryReport(slam)},
          {"threads", options.num_threads},
          {"warnings", *run.warnings},
          {"flags", FlagsReport(run.settings->flags)},
          {"flags_given", GivenFlagsReport(run.settings->flags)},
          {"command", CommandText("ed_slam", {run.settings->input}, run.settings->flags)},
          {"backend", BackendReport()}};
}

}  // namespace ceres_ed
