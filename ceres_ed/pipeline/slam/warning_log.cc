#include "ceres_ed/pipeline/slam/warning_log.h"

#include <algorithm>

namespace ceres_ed {
namespace {

constexpr int kMostOfAKind = 5;

}  // namespace

void WarningLog::Add(const std::string& kind, const std::string& sentence) {
  if (std::find(sentences_.begin(), sentences_.end(), sentence) != sentences_.end()) return;
  const int count = ++counts_[kind];
  if (count > kMostOfAKind) return;
  const std::string end =
      count == kMostOfAKind ? " (further warnings of this kind are not shown)" : "";
  sentences_.push_back(sentence + end);
  observer_->OnWarning(sentences_.back());
}

}  // namespace ceres_ed
