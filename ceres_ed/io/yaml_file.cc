// The only file that includes yaml-cpp.
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/shown_text.h>

#include <exception>
#include <optional>
#include <utility>

#include <yaml-cpp/yaml.h>

namespace ceres_ed {
namespace {

using nlohmann::json;

// Deeper files are refused: recursion must end before the stack does.
constexpr int kDeepest = 64;

json ScalarValue(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  // A text in quotes is no number.
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "True") return true;
  if (text == "false" || text == "False") return false;
  if (const std::optional<double> number = ParseDouble(text)) return *number;
  return text;
}

StatusOr<json> ToJson(const std::string& path, const YAML::Node& node, int depth) {
  if (depth > kDeepest) {
    return Status::Error(path + ": values are nested more than " + std::to_string(kDeepest) +
                         " deep, expected a calibration or a list");
  }
  if (node.IsScalar()) return ScalarValue(node);
  if (node.IsSequence()) {
    json list = json::array();
    for (const YAML::Node& item : node) {
      StatusOr<json> value = ToJson(path, item, depth + 1);
      if (!value.ok()) return value.status();
      list.push_back(*std::move(value));
    }
    return list;
  }
  if (node.IsMap()) {
    json map = json::object();
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) {
        return Status::Error(path + ": line " + std::to_string(entry.first.Mark().line + 1) +
                             ": a key is a list or a map, expected a word");
      }
      StatusOr<json> value = ToJson(path, entry.second, depth + 1);
      if (!value.ok()) return value.status();
      map[entry.first.Scalar()] = *std::move(value);
    }
    return map;
  }
  return json();
}

}  // namespace

StatusOr<json> ReadYamlFile(const std::string& path) {
  StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return text.status();
  // OpenCV writes "%YAML:1.0", which is no directive of YAML.
  if (text->rfind("%YAML", 0) == 0) (*text)[0] = '#';
  try {
    return ToJson(path, YAML::Load(*text), 0);
  } catch (const YAML::Exception& error) {
    return Status::Error(path + ": line " + std::to_string(error.mark.line + 1) +
                         ": no YAML: " + ShownLine(error.msg));
  } catch (const std::exception& error) {
    return Status::Error(path + ": no YAML: " + ShownLine(error.what()));
  }
}

}  // namespace ceres_ed
