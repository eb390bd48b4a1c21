#include "ceres_ed/io/json_file.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/shown_text.h>

#include <exception>
#include <utility>

namespace ceres_ed {

StatusOr<nlohmann::json> ReadJsonFile(const std::string& path) {
  const StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return text.status();
  try {
    return nlohmann::json::parse(*text);
  } catch (const std::exception& error) {
    return Status::Error(path + ": no JSON: " + ShownLine(error.what()));
  }
}

}  // namespace ceres_ed
