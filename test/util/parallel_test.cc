#include <ceres_ed/util/parallel.h>

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnceAtAnyThreadCount) {
  for (const int num_threads : {-1, 0, 1, 2, 3, 7, 100}) {
    for (const int count : {1, 2, 5, 97}) {
      std::vector<int> visits(count, 0);
      ParallelFor(num_threads, count, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << num_threads << " threads, " << count;
    }
  }
}

TEST(ParallelFor, RunsInlineOnOneThread) {
  std::thread::id worker;
  ParallelFor(1, 10, [&](int begin, int end) {
    EXPECT_EQ(begin, 0);
    EXPECT_EQ(end, 10);
    worker = std::this_thread::get_id();
  });
  EXPECT_EQ(worker, std::this_thread::get_id());
}

TEST(ParallelFor, CallsNothingForAnEmptyRange) {
  int calls = 0;
  ParallelFor(4, 0, [&](int, int) { ++calls; });
  EXPECT_EQ(calls, 0);
}

TEST(ParallelFor, HasTheSameRangesWithinABody) {
  const auto ends_of = [] {
    std::vector<int> ends(10, 0);
    ParallelFor(3, 10, [&](int begin, int end) { ends[begin] = end; });
    return ends;
  };
  const std::vector<int> outside = ends_of();
  ParallelFor(2, 2, [&](int, int) { EXPECT_EQ(ends_of(), outside); });
}

}  // namespace
}  // namespace ceres_ed
