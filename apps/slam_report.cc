#include "apps/slam_report.h"

#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <numeric>

#include <sys/resource.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

// The values of a column in the frames whose camera is known.
std::vector<double> ColumnOf(const std::vector<FrameRecord>& records, const std::string& name) {
  std::vector<double> values;
  for (const FrameRecord& record : records) {
    if (HasPose(record.status)) values.push_back(record[name]);
  }
  return values;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double Mean(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

ordered_json Statistics(const std::vector<double>& values) {
  return {{"median", Median(values)},
          {"mean", Mean(values)},
          {"max", values.empty() ? 0.0 : *std::max_element(values.begin(), values.end())}};
}

// The most memory that the process has held, MiB.
double PeakMemoryMib() {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// What it holds now, MiB; 0 where the system doesn't say.
double ResidentMemoryMib() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  if (!(file >> total >> resident)) return 0.0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

// The map's share, by owner, in bytes.
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
          {"per_node", per(memory.OfNodes(), slam.map().graph().num_nodes())},
          {"per_point", per(memory.OfPoints(), slam.map().num_points())},
          {"resident_mib", ResidentMemoryMib()}};
}

ordered_json SequenceReport(const SlamRun& run) {
  const DepthSequence& sequence = *run.sequence;
  const PinholeCamera& camera = sequence.camera();
  return {{"path", run.sequence_path},
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
          {"depth_units_per_metre", sequence.depth_units_per_metre()},
          {"color", sequence.has_color()}};
}

ordered_json FramesReport(const std::vector<FrameRecord>& records) {
  ordered_json report = {{"processed", records.size()}};
  for (const FrameStatus status : {FrameStatus::kInitialized,
                                   FrameStatus::kTracked,
                                   FrameStatus::kRelocalized,
                                   FrameStatus::kLost,
                                   FrameStatus::kSkipped}) {
    report[FrameStatusName(status)] = CountFrames(records, status);
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
    if (name.rfind("t_", 0) == 0) report[name] = Statistics(ColumnOf(*run.records, name));
  }
  return report;
}

template <typename... Arguments>
std::string Line(const char* format, Arguments... arguments) {
  char text[256];
  std::snprintf(text, sizeof(text), format, arguments...);
  return text;
}

}  // namespace

int CountFrames(const std::vector<FrameRecord>& records, FrameStatus status) {
  return static_cast<int>(std::count_if(
      records.begin(), records.end(), [status](const auto& r) { return r.status == status; }));
}

ordered_json SlamReport(const SlamRun& run) {
  const SlamOptions& options = run.settings->options;
  const DeformableSlam& slam = *run.slam;
  return {{"program", "ed_slam"},
          {"version", kVersion},
          {"mode", SlamModeName(options.levels.strategy.mode)},
          {"camera", CameraModeName(options.camera)},
          {"status", run.status},
          {"message", run.message},
          {"sequence", SequenceReport(run)},
          {"frames", FramesReport(*run.records)},
          {"nodes", NodesReport(slam)},
          {"map", {{"points", slam.map().num_points()}, {"node_spacing", slam.unit()}}},
          {"derived",
           {{"node_spacing", slam.unit()},
            {"point_spacing", options.growth.point_spacing * slam.unit()},
            {"features", options.features && run.sequence->has_color()}}},
          {"rms_plane", Statistics(ColumnOf(*run.records, "rms_plane"))},
          {"time_s", TimeReport(run)},
          {"memory_peak_mib", PeakMemoryMib()},
          {"memory", MemoryReport(slam)},
          {"threads", options.num_threads},
          {"warnings", *run.warnings},
          {"flags", FlagsReport(run.settings->flags)},
          {"backend", BackendReport()}};
}

std::string SlamSummary(const SlamRun& run) {
  const std::vector<FrameRecord>& records = *run.records;
  const DeformableSlam& slam = *run.slam;
  const double median_s = Median(ColumnOf(records, "t_total"));
  return Line("status     %s: %s\n", run.status.c_str(), run.message.c_str()) +
         Line("frames     %zu: %d tracked, %d relocalized, %d lost, %d skipped\n",
              records.size(),
              CountFrames(records, FrameStatus::kTracked) +
                  CountFrames(records, FrameStatus::kInitialized),
              CountFrames(records, FrameStatus::kRelocalized),
              CountFrames(records, FrameStatus::kLost),
              CountFrames(records, FrameStatus::kSkipped)) +
         Line("map        %d points, %d nodes %.3g mm apart\n",
              slam.map().num_points(),
              slam.map().graph().num_nodes(),
              1e3 * slam.unit()) +
         Line("rms        %.3g mm to planes (median of the frames)\n",
              1e3 * Median(ColumnOf(records, "rms_plane"))) +
         Line("time       %.2f s, %.1f ms a frame (median)\n", run.total_s, 1e3 * median_s) +
         "output     " + run.settings->output + "\n";
}

std::string ProgressJson(const FrameRecord& record, int done, int total, double frames_per_s) {
  ordered_json line = {{"frame", record.number}, {"status", FrameStatusName(record.status)}};
  for (std::size_t i = 0; i < kFrameColumns.size(); ++i) line[kFrameColumns[i]] = record.values[i];
  line["done"] = done;
  line["total"] = total;
  line["frames_per_s"] = frames_per_s;
  return line.dump() + "\n";
}

std::string ProgressNote(const FrameRecord& record, double frames_per_s) {
  return Line("%s, %.1f frames/s, %.0f nodes, rms %.3g mm",
              FrameStatusName(record.status).c_str(),
              frames_per_s,
              record["nodes"],
              1e3 * record["rms_plane"]);
}

}  // namespace ceres_ed
