// A wall-clock stopwatch.
#ifndef CERES_ED_UTIL_TIMER_H_
#define CERES_ED_UTIL_TIMER_H_

#include <chrono>

namespace ceres_ed {

// Starts when it is made. Monotonic: a change of the system's time does not touch it.
class Timer {
 public:
  // Seconds since the start or the last Restart().
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  // Returns Seconds() and starts anew from zero.
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
