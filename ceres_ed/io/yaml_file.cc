// The only file that includes yaml-cpp.
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/shown_text.h>

#include <cstddef>
#include <exception>
#include <optional>
#include <utility>

#include <yaml-cpp/yaml.h>

namespace ceres_ed {
namespace {

using nlohmann::json;

json ScalarValue(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  // A text in quotes is no number.
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "True") return true;
  if (text == "false" || text == "False") return false;
  if (const std::optional<double> number = ParseDouble(text)) return *number;
  return text;
}

// Makes JSON of the nodes of a file. An alias stands for a whole part of the file: a few lines of
// aliases of aliases stand for more values than any memory holds, so that they are counted.
class NodeReader {
 public:
  NodeReader(const std::string& path, std::size_t most_values)
      : path_(path), values_left_(most_values) {}

  StatusOr<json> Read(const YAML::Node& node, int depth) {
    if (depth > kDeepestValue) {
      return Status::Error(path_ + ": values are nested more than " +
                           std::to_string(kDeepestValue) +
                           " deep, expected a calibration or a list");
    }
    if (values_left_ == 0) {
      return Status::Error(path_ +
                           ": its aliases stand for more values than it has bytes, expected values "
                           "that are written out");
    }
    --values_left_;
    if (node.IsScalar()) return ScalarValue(node);
    if (node.IsSequence()) return ReadSequence(node, depth);
    return node.IsMap() ? ReadMap(node, depth) : json();
  }

 private:
  StatusOr<json> ReadSequence(const YAML::Node& node, int depth) {
    json list = json::array();
    for (const YAML::Node& item : node) {
      StatusOr<json> value = Read(item, depth + 1);
      if (!value.ok()) return value.status();
      list.push_back(*std::move(value));
    }
    return list;
  }

  StatusOr<json> ReadMap(const YAML::Node& node, int depth) {
    json map = json::object();
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) {
        return Status::Error(path_ + ": line " + std::to_string(entry.first.Mark().line + 1) +
                             ": a key is a list or a map, expected a word");
      }
      StatusOr<json> value = Read(entry.second, depth + 1);
      if (!value.ok()) return value.status();
      map[entry.first.Scalar()] = *std::move(value);
    }
    return map;
  }

  const std::string& path_;
  std::size_t values_left_;
};

}  // namespace

StatusOr<json> ReadYamlFile(const std::string& path) {
  StatusOr<std::string> text = ReadWholeFile(path);
  if (!text.ok()) return text.status();
  // OpenCV writes "%YAML:1.0", which is no directive of YAML.
  if (text->rfind("%YAML", 0) == 0) (*text)[0] = '#';
  try {
    // Each value has at least a byte, but for the whole of an empty file.
    return NodeReader(path, text->size() + 1).Read(YAML::Load(*text), 0);
  } catch (const YAML::Exception& error) {
    return Status::Error(path + ": line " + std::to_string(error.mark.line + 1) +
                         ": no YAML: " + ShownLine(error.msg));
  } catch (const std::exception& error) {
    return Status::Error(path + ": no YAML: " + ShownLine(error.what()));
  }
}

}  // namespace ceres_ed
