#include <ceres_ed/pipeline/cohort/job_pool.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;

const auto kGoOn = [](int) { return true; };

void Nap() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

TEST(RunJobs, RunsEachJobOnce) {
  std::vector<std::atomic<int>> runs(20);
  const int ended = RunJobs(
      std::vector<std::size_t>(20, 1), {4, 0}, [&runs](int job) { ++runs[job]; }, kGoOn);
  EXPECT_EQ(ended, 20);
  for (const std::atomic<int>& run : runs) EXPECT_EQ(run, 1);
}

TEST(RunJobs, RunsSeveralAtATime) {
  std::atomic<int> at_work{0};
  std::atomic<int> most{0};
  RunJobs(
      std::vector<std::size_t>(8, 1),
      {4, 0},
      [&](int) {
        const int now = ++at_work;
        most = std::max(most.load(), now);
        Nap();
        --at_work;
      },
      kGoOn);
  EXPECT_GT(most, 1);
  EXPECT_LE(most, 4);
}

TEST(RunJobs, StaysWithinTheMemory) {
  const std::vector<std::size_t> needs = {3, 2, 50, 1, 2, 3, 1, 1};
  std::mutex mutex;
  std::size_t used = 0;
  int at_work = 0;
  RunJobs(
      needs,
      {4, 5},
      [&](int job) {
        {
          const std::lock_guard<std::mutex> lock(mutex);
          used += needs[job];
          ++at_work;
          // What is larger than the bound runs alone.
          EXPECT_TRUE(used <= 5 || at_work == 1) << used;
        }
        Nap();
        const std::lock_guard<std::mutex> lock(mutex);
        used -= needs[job];
        --at_work;
      },
      kGoOn);
}

TEST(RunJobs, BeginsNoJobAfterAStop) {
  std::atomic<int> begun{0};
  const int ended = RunJobs(
      std::vector<std::size_t>(1000, 1),
      {2, 0},
      [&begun](int) {
        ++begun;
        Nap();
      },
      [](int done) { return done < 3; });
  EXPECT_LT(ended, 100);
  EXPECT_EQ(ended, begun);
}

TEST(RunJobs, OneThreadKeepsTheOrder) {
  std::vector<int> order;
  RunJobs(
      {1, 1, 1}, {1, 0}, [&order](int job) { order.push_back(job); }, kGoOn);
  EXPECT_THAT(order, ElementsAre(0, 1, 2));
}

TEST(RunJobs, DoesNothingWithoutJobs) {
  EXPECT_EQ(RunJobs(
                {}, {2, 0}, [](int) { FAIL(); }, kGoOn),
            0);
}

}  // namespace
}  // namespace ceres_ed
