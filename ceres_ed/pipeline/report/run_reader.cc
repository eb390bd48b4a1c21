#include "ceres_ed/pipeline/report/run_reader.h"

#include <ceres_ed/io/text.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace ceres_ed {

using nlohmann::ordered_json;

std::string FinishedRun::Find(const std::string& name) const {
  if (name.empty()) return name;
  std::error_code error;
  if (std::filesystem::exists(name, error)) return name;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  // Runs are moved with their files, so that only the names stay.
  for (const std::filesystem::path& other :
       {folder / name, folder / std::filesystem::path(name).filename()}) {
    if (std::filesystem::exists(other, error)) return other.string();
  }
  return name;
}

StatusOr<FinishedRun> ReadFinishedRun(const std::string& path) {
  FinishedRun run;
  run.path = path;
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    run.path = (std::filesystem::path(path) / "report.json").string();
  }
  StatusOr<std::string> text = ReadWholeFile(run.path);
  if (!text.ok()) return text.status();
  // Values that lie deeper than those of any report are left out: what works on a value works on
  // all that it has in it, and the stack is not without end.
  constexpr int kMaxDepth = 64;
  const auto is_kept = [](int depth,
                          ordered_json::parse_event_t /*event*/,
                          ordered_json& /*value*/) { return depth <= kMaxDepth; };
  run.report = ordered_json::parse(*text, is_kept, /*allow_exceptions=*/false);
  if (run.report.is_discarded()) {
    return Status::Error(run.path + ": is no JSON, expected the report.json of a run");
  }
  if (!run.report.is_object() || !run.report.contains("program")) {
    return Status::Error(run.path + ": has no \"program\", expected the report.json of a run");
  }
  return run;
}

}  // namespace ceres_ed
