#include <ceres_ed/util/timer.h>

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(Timer, MeasuresAtLeastTheTimeSlept) {
  const Timer timer;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(timer.Seconds(), 0.005);
}

TEST(Timer, RestartReturnsTheTimeAndStartsFromZero) {
  Timer timer;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double before = timer.Restart();
  EXPECT_GE(before, 0.020);
  // Two calls in a row take much less time than the sleep.
  EXPECT_LT(timer.Seconds(), before);
}

}  // namespace
}  // namespace ceres_ed
