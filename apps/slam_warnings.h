// Warnings of a run, each told once.
#ifndef CERES_ED_APPS_SLAM_WARNINGS_H_
#define CERES_ED_APPS_SLAM_WARNINGS_H_

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Prints warnings to stderr as they come, and keeps them for the report. Of one kind only the first
// few: a sequence may have a thousand damaged files.
class WarningLog {
 public:
  explicit WarningLog(std::string program) : program_(std::move(program)) {}

  // A sentence that is there already is not told again.
  void Add(const std::string& kind, const std::string& sentence);

  // Takes over what an earlier run has told.
  void Restore(std::vector<std::string> sentences) { sentences_ = std::move(sentences); }

  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  std::string program_;
  std::vector<std::string> sentences_;
  std::map<std::string, int> counts_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_WARNINGS_H_
