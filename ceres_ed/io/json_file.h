// Reads files of nested values. A YAML file becomes the same kind of value as a JSON file.
#ifndef CERES_ED_IO_JSON_FILE_H_
#define CERES_ED_IO_JSON_FILE_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Values may lie this deep in one another. No file of ours, of a camera or of landmarks comes near
// it; what works on a value calls itself for the values in it, and the stack has an end.
inline constexpr int kDeepestValue = 64;

// Refuses a JSON text with lists and objects more than kDeepestValue deep in one another. The error
// begins with `path` and names the byte.
Status CheckJsonDepth(const std::string& path, std::string_view text);

// Parses the text of the file `path`: every JSON file is parsed by this function. Json is
// nlohmann::json, or nlohmann::ordered_json, which keeps the order of the members. The error begins
// with `path` and says where the text is no JSON or too deep.
template <typename Json>
StatusOr<Json> ParseJson(const std::string& path, std::string_view text);
extern template StatusOr<nlohmann::json> ParseJson(const std::string&, std::string_view);
extern template StatusOr<nlohmann::ordered_json> ParseJson(const std::string&, std::string_view);

// Reads a JSON file. The error names the file: it can't be read, or is no JSON.
StatusOr<nlohmann::json> ReadJsonFile(const std::string& path);

// Reads a YAML file, also one that OpenCV has written. Words such as true and null, and numbers,
// get these types; other scalars are texts. A key that is a number becomes a text. Errors are as
// those of ReadJsonFile(), with the line of the mistake. Values that repeat others (aliases) may
// not make it larger than its text.
StatusOr<nlohmann::json> ReadYamlFile(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_JSON_FILE_H_
