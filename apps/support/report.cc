#include "apps/support/report.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/linear_algebra/linear_algebra_backend.h>

#include <string>

#include <apps/support/command_line.h>

namespace ceres_ed {

using nlohmann::ordered_json;

Status WriteReport(const std::string& path, const ordered_json& report) {
  const auto replace = ordered_json::error_handler_t::replace;
  return WriteFileAtomically(path, report.dump(2, ' ', false, replace) + "\n");
}

ordered_json FlagsReport() {
  ordered_json flags = ordered_json::object();
  for (const auto& flag : OwnFlags()) {
    const std::string& value = flag.current_value;
    if (flag.type == "bool") {
      flags[flag.name] = value == "true";
    } else if (flag.type == "string") {
      flags[flag.name] = value;
    } else if (flag.type == "double") {
      flags[flag.name] = std::stod(value);
    } else {
      flags[flag.name] = std::stoll(value);
    }
  }
  return flags;
}

ordered_json BackendReport() {
  const LinearAlgebraBackend backend = DescribeBackend();
  return {{"ceres", backend.ceres_version},
          {"sparse_library", backend.sparse_library},
          {"ordering_library", backend.ordering_library},
          {"blas", backend.blas},
          {"kernels", backend.kernels}};
}

}  // namespace ceres_ed
