// Warnings of a run, each told once.
#ifndef CERES_ED_PIPELINE_SLAM_WARNING_LOG_H_
#define CERES_ED_PIPELINE_SLAM_WARNING_LOG_H_

#include <ceres_ed/pipeline/run_observer.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Hands warnings to an observer as they come, and keeps them for the report. Of one kind only the
// first few: a sequence may have a thousand damaged files.
class WarningLog {
 public:
  // `observer` must outlive this.
  explicit WarningLog(RunObserver* observer) : observer_(observer) {}

  // A sentence that is there already is not told again.
  void Add(const std::string& kind, const std::string& sentence);

  // Takes over what an earlier part of the run has told.
  void Restore(std::vector<std::string> sentences) { sentences_ = std::move(sentences); }

  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  RunObserver* observer_;
  std::vector<std::string> sentences_;
  std::map<std::string, int> counts_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_WARNING_LOG_H_
