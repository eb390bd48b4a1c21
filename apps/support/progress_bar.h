// A progress bar for terminals.
#ifndef CERES_ED_APPS_SUPPORT_PROGRESS_BAR_H_
#define CERES_ED_APPS_SUPPORT_PROGRESS_BAR_H_

#include <ceres_ed/util/timer.h>

#include <string>

namespace ceres_ed {

// Returns how long a run will still take if it goes on as it did, in words: "about 40 s left".
// Returns an empty text for the first second, before anything is done, and at the end.
std::string TimeLeft(double seconds_gone, int done, int total);

// One line on stderr that is drawn anew at each step and removed at the end. Nothing is drawn if
// stderr is not a terminal.
class ProgressBar {
 public:
  // `total` > 0 is the number of steps. If `quiet`, nothing is drawn.
  ProgressBar(std::string title, int total, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  int total() const { return total_; }

  // Shows that `done` steps are finished, a few words about the progress, and an estimate of the
  // time that is left.
  void Update(int done, const std::string& note);

 private:
  std::string title_;
  int total_;
  bool visible_;
  const Timer clock_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_PROGRESS_BAR_H_
