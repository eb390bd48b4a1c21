#include "apps/support/run_flags.h"

#include <string>

#include <apps/support/command_line.h>

namespace ceres_ed {
namespace {

RunFlag::Type TypeOf(const std::string& type) {
  if (type == "bool") return RunFlag::Type::kBool;
  if (type == "string") return RunFlag::Type::kText;
  return type == "double" ? RunFlag::Type::kNumber : RunFlag::Type::kInteger;
}

}  // namespace

RunFlags CurrentFlags() {
  RunFlags flags;
  for (const auto& flag : OwnFlags()) {
    flags.push_back(
        {flag.name, CurrentValue(flag.name), TypeOf(flag.type), /*is_given=*/!flag.is_default});
  }
  return flags;
}

}  // namespace ceres_ed
