// A wall-clock stopwatch.
#ifndef CERES_ED_UTIL_TIMER_H_
#define CERES_ED_UTIL_TIMER_H_

#include <chrono>

namespace ceres_ed {

// A stopwatch that starts when it is constructed. It uses a monotonic clock, so changes of the
// system time do not affect it.
class Timer {
 public:
  // Returns the seconds since the start or the last Restart().
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  // Returns Seconds() and restarts from zero.
  double Restart() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_TIMER_H_
