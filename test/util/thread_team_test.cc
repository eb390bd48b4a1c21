#include <ceres_ed/util/thread_team.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

// Returns the ids of the threads that take part when each of `count` tasks waits for all others.
std::set<std::thread::id> ThreadsThatMeet(int count) {
  std::vector<std::thread::id> ids(count);
  std::atomic<int> arrived{0};
  RunTasks(count, [&](int i) {
    ids[i] = std::this_thread::get_id();
    ++arrived;
    while (arrived < count) std::this_thread::yield();
  });
  return {ids.begin(), ids.end()};
}

TEST(RunTasks, RunsEachTaskOnce) {
  for (int num_tasks = 0; num_tasks < 20; ++num_tasks) {
    std::vector<std::atomic<int>> runs(num_tasks);
    RunTasks(num_tasks, [&](int i) { ++runs[i]; });
    for (const std::atomic<int>& count : runs) EXPECT_EQ(count, 1) << num_tasks << " tasks";
  }
}

TEST(RunTasks, SeesWhatTasksOfManyQuickCallsHaveWritten) {
  std::vector<int> values(4, 0);
  for (int call = 0; call < 20000; ++call) {
    RunTasks(4, [&](int i) { values[i] += i; });
  }
  EXPECT_EQ(values, (std::vector<int>{0, 20000, 40000, 60000}));
}

TEST(RunTasks, UsesAsManyThreadsAsTasksAndTheSameAgain) {
  // Another calling thread has a team of its own.
  std::thread([] {
    const std::set<std::thread::id> first = ThreadsThatMeet(3);
    EXPECT_EQ(first.size(), 3U);
    EXPECT_EQ(first.count(std::this_thread::get_id()), 1U);
    // This is long enough for all helpers to fall asleep.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(ThreadsThatMeet(3), first);
  }).join();
}

TEST(RunTasks, RunsCallsWithinATaskOnItsThread) {
  std::vector<std::thread::id> outer(2);
  std::vector<std::set<std::thread::id>> inner(2);
  RunTasks(2, [&](int i) {
    outer[i] = std::this_thread::get_id();
    RunTasks(3, [&, i](int) { inner[i].insert(std::this_thread::get_id()); });
  });
  for (int i = 0; i < 2; ++i) EXPECT_EQ(inner[i], std::set<std::thread::id>{outer[i]});
}

TEST(RunTasks, DoesNotWaitForAHelperThatIsSlow) {
  // A helper is stuck in the first task that it gets. Meanwhile the caller takes all others.
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> by_caller{0};
  std::atomic<int> by_helper{0};
  RunTasks(2, [](int) {});
  RunTasks(50, [&](int) {
    if (std::this_thread::get_id() == caller) {
      ++by_caller;
    } else {
      ++by_helper;
      while (by_caller + by_helper < 50) std::this_thread::yield();
    }
  });
  EXPECT_EQ(by_caller + by_helper, 50);
  EXPECT_GE(by_caller, 1);
}

TEST(RunTasks, ServesSeveralCallersAtOnce) {
  std::vector<long> sums(4, 0);
  std::vector<std::thread> callers;
  for (int c = 0; c < 4; ++c) {
    callers.emplace_back([&sums, c] {
      std::vector<long> parts(3);
      for (int call = 0; call < 500; ++call) {
        RunTasks(3, [&](int i) { parts[i] += c * i; });
      }
      sums[c] = std::accumulate(parts.begin(), parts.end(), 0L);
    });
  }
  for (std::thread& caller : callers) caller.join();
  for (int c = 0; c < 4; ++c) EXPECT_EQ(sums[c], 1500L * c);
}

TEST(RunTasks, WorksInAForkedChild) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the sanitizer lets no child of a process with threads start some";
#endif
  ThreadsThatMeet(2);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  // A call that waited for the parent's helpers would never end.
  if (child == 0) {
    alarm(20);
    std::atomic<int> runs{0};
    RunTasks(4, [&](int) { ++runs; });
    _exit(runs == 4 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(RunTasks, LetsTheProcessExitFromATask) {
  // The death test starts a new process and does not fork this one.
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        alarm(20);
        RunTasks(2, [](int i) {
          if (i == 0) std::exit(7);
        });
      },
      testing::ExitedWithCode(7),
      "");
}

}  // namespace
}  // namespace ceres_ed
