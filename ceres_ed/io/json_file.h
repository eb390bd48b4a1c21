// Reads files of nested values. A YAML file becomes the same kind of value as a JSON file.
#ifndef CERES_ED_IO_JSON_FILE_H_
#define CERES_ED_IO_JSON_FILE_H_

#include <ceres_ed/util/status.h>

#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Reads a JSON file. The error names the file: it can't be read, or is no JSON.
StatusOr<nlohmann::json> ReadJsonFile(const std::string& path);

// Reads a YAML file, also one that OpenCV has written. Words such as true and null, and numbers,
// get these types; other scalars are texts. A key that is a number becomes a text. Errors are as
// those of ReadJsonFile(), with the line of the mistake.
StatusOr<nlohmann::json> ReadYamlFile(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_JSON_FILE_H_
