#include "ceres_ed/pipeline/report.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/linear_algebra/linear_algebra_backend.h>

#include <string>

namespace ceres_ed {

using nlohmann::ordered_json;

namespace {

// Returns the integer in `text`. Some flags are unsigned numbers of 64 bits, which do not fit into
// a long long.
ordered_json IntegerOf(const std::string& text) {
  if (text[0] == '-') return std::stoll(text);
  return std::stoull(text);
}

}  // namespace

Status WriteReport(const std::string& path, const ordered_json& report) {
  const auto replace = ordered_json::error_handler_t::replace;
  return WriteFileAtomically(path, report.dump(2, ' ', false, replace) + "\n");
}

ordered_json FlagsReport(const RunFlags& flags) {
  ordered_json report = ordered_json::object();
  for (const RunFlag& flag : flags) {
    switch (flag.type) {
      case RunFlag::Type::kBool:
        report[flag.name] = flag.value == "true";
        break;
      case RunFlag::Type::kInteger:
        report[flag.name] = IntegerOf(flag.value);
        break;
      case RunFlag::Type::kNumber:
        report[flag.name] = std::stod(flag.value);
        break;
      case RunFlag::Type::kText:
        report[flag.name] = flag.value;
        break;
    }
  }
  return report;
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
