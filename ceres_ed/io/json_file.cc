#include "ceres_ed/io/json_file.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/shown_text.h>

#include <cstddef>
#include <exception>
#include <utility>

namespace ceres_ed {

Status CheckJsonDepth(const std::string& path, std::string_view text) {
  int depth = 0;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        is_in_string = false;
      }
    } else if (c == '"') {
      is_in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestValue) {
        return Status::Error(
            path + ": byte " + std::to_string(i) + ": values lie more than " +
            std::to_string(kDeepestValue) +
            " deep in one another, expected fewer lists and objects in each other");
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return Status::Ok();
}

template <typename Json>
StatusOr<Json> ParseJson(const std::string& path, std::string_view text) {
  if (Status status = CheckJsonDepth(path, text); !status.ok()) return status;
  try {
    return Json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    return Status::Error(path + ": no JSON, or cut off: no valid value at byte " +
                         std::to_string(error.byte));
  } catch (const nlohmann::json::out_of_range&) {
    return Status::Error(path + ": no JSON: a number is beyond the range of double");
  } catch (const nlohmann::json::exception& error) {
    return Status::Error(path + ": no JSON: " + ShownLine(error.what()));
  }
}

template StatusOr<nlohmann::json> ParseJson(const std::string&, std::string_view);
template StatusOr<nlohmann::ordered_json> ParseJson(const std::string&, std::string_view);

StatusOr<nlohmann::json> ReadJsonFile(const std::string& path) {
  const StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return text.status();
  return ParseJson<nlohmann::json>(path, *text);
}

}  // namespace ceres_ed
