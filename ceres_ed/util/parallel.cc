#include "ceres_ed/util/parallel.h"

#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

namespace ceres_ed {

void ParallelFor(int num_threads, int count, const std::function<void(int begin, int end)>& body) {
  if (count <= 0) return;
  const int num_ranges = std::min(num_threads, count);
  if (num_ranges <= 1) {
    body(0, count);
    return;
  }
  const auto range_begin = [&](int i) {
    return static_cast<int>(static_cast<std::int64_t>(count) * i / num_ranges);
  };
  std::vector<std::thread> threads;
  threads.reserve(num_ranges - 1);
  for (int i = 1; i < num_ranges; ++i) {
    threads.emplace_back(
        [&body, begin = range_begin(i), end = range_begin(i + 1)] { body(begin, end); });
  }
  body(0, range_begin(1));
  for (std::thread& thread : threads) thread.join();
}

}  // namespace ceres_ed
