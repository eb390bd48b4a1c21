// The flags with which a run was started, as data for reports and checkpoints.
#ifndef CERES_ED_PIPELINE_RUN_FLAG_H_
#define CERES_ED_PIPELINE_RUN_FLAG_H_

#include <string>
#include <vector>

namespace ceres_ed {

struct RunFlag {
  enum class Type { kBool, kInteger, kNumber, kText };

  std::string name;
  // "true" or "false" for kBool. A number has the fewest digits from which the same number is read.
  std::string value;
  Type type = Type::kText;
  // Whether it stood on the command line; otherwise the value is the default.
  bool is_given = false;
};

using RunFlags = std::vector<RunFlag>;

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_RUN_FLAG_H_
