// The warnings of a run, each of which is shown once.
#ifndef CERES_ED_PIPELINE_SLAM_WARNING_LOG_H_
#define CERES_ED_PIPELINE_SLAM_WARNING_LOG_H_

#include <ceres_ed/pipeline/run_observer.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Passes warnings to an observer when they occur, and keeps them for the report. Only the first few
// of a kind are kept, because a sequence may have a thousand damaged files.
class WarningLog {
 public:
  // `observer` must outlive this.
  explicit WarningLog(RunObserver* observer) : observer_(observer) {}

  // Adds a warning, unless the same sentence has been added before.
  void Add(const std::string& kind, const std::string& sentence);

  // Restores the warnings of the earlier part of a run.
  void Restore(std::vector<std::string> sentences) { sentences_ = std::move(sentences); }

  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  RunObserver* observer_;
  std::vector<std::string> sentences_;
  std::map<std::string, int> counts_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_WARNING_LOG_H_
