#include "ceres_ed/pipeline/outputs.h"

#include <ceres_ed/io/atomic_file.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string_view>
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

bool IsFolderOfSequence(const std::string& output, const std::string& sequence) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::equivalent(output, sequence, error)) return true;
  const fs::path inner = fs::canonical(output, error);
  // It does not exist yet.
  if (error) return false;
  const fs::path outer = fs::canonical(sequence, error);
  if (error ||
      std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first != outer.end()) {
    return false;
  }
  constexpr std::array<std::string_view, 6> kPictures = {
      ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".npy"};
  for (fs::directory_iterator entry(inner, error), end; !error && entry != end;
       entry.increment(error)) {
    std::string ending = entry->path().extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (std::find(kPictures.begin(), kPictures.end(), ending) != kPictures.end()) return true;
  }
  return false;
}

}  // namespace ceres_ed
