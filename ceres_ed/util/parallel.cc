#include "ceres_ed/util/parallel.h"

#include <ceres_ed/util/thread_team.h>

#include <algorithm>
#include <cstdint>

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
  RunTasks(num_ranges, [&](int i) { body(range_begin(i), range_begin(i + 1)); });
}

}  // namespace ceres_ed
