#include "ceres_ed/pipeline/report/run_reader.h"

#include <ceres_ed/io/json_file.h>
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
  StatusOr<ordered_json> report = ParseJson<ordered_json>(run.path, *text);
  if (!report.ok()) return report.status();
  run.report = *std::move(report);
  if (!run.report.is_object() || !run.report.contains("program")) {
    return Status::Error(run.path + ": has no \"program\", expected the report.json of a run");
  }
  return run;
}

}  // namespace ceres_ed
