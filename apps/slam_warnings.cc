#include "apps/slam_warnings.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <unistd.h>

namespace ceres_ed {
namespace {

constexpr int kMostOfAKind = 5;
// Wipes a progress bar that stands where the warning goes.
constexpr char kClearLine[] = "\r\x1b[K";

}  // namespace

void WarningLog::Add(const std::string& kind, const std::string& sentence) {
  if (std::find(sentences_.begin(), sentences_.end(), sentence) != sentences_.end()) return;
  const int count = ++counts_[kind];
  if (count > kMostOfAKind) return;
  const std::string end = count == kMostOfAKind ? " (more of this kind are not told)" : "";
  sentences_.push_back(sentence + end);
  std::fprintf(stderr,
               "%s%s: warning: %s\n",
               isatty(STDERR_FILENO) != 0 ? kClearLine : "",
               program_.c_str(),
               sentences_.back().c_str());
}

}  // namespace ceres_ed
