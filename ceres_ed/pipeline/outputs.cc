#include "ceres_ed/pipeline/outputs.h"

#include <ceres_ed/io/atomic_file.h>

#include <filesystem>
#include <memory>
#include <system_error>

namespace ceres_ed {

Status PrepareOutput(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return Status::Error(path + ": is a folder, expected the name of a file to write, such as " +
                         (std::filesystem::path(path) / "fitted.ply").string());
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) {
    return Status::Error(path + ": the folder " + folder.string() +
                         " cannot be made: " + error.message());
  }
  // Only an attempt shows whether permissions and mounts allow the file. It is discarded.
  const StatusOr<std::unique_ptr<AtomicFile>> probe = AtomicFile::Create(path);
  return probe.status();
}

}  // namespace ceres_ed
