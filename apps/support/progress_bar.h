// A progress line for people who watch a terminal.
#ifndef CERES_ED_APPS_SUPPORT_PROGRESS_BAR_H_
#define CERES_ED_APPS_SUPPORT_PROGRESS_BAR_H_

#include <string>

namespace ceres_ed {

// One line on stderr that is drawn over and wiped at the end. Silent when stderr is no terminal.
class ProgressBar {
 public:
  // `total` > 0 steps are expected; `quiet` draws nothing anywhere.
  ProgressBar(std::string title, int total, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  int total() const { return total_; }

  // Shows that `done` steps are behind us, with a few words on how it goes.
  void Update(int done, const std::string& note);

 private:
  std::string title_;
  int total_;
  bool visible_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_PROGRESS_BAR_H_
