#include <ceres_ed/io/json_file.h>

namespace ceres_ed {

StatusOr<nlohmann::json> ReadYamlFile(const std::string& path) {
  return Status::Error(path + ": this build of ceres_ed reads no sequences: install OpenCV and " +
                       "libyaml-cpp-dev, and build again");
}

}  // namespace ceres_ed
