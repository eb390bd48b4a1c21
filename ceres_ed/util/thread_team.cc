#include "ceres_ed/util/thread_team.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <unistd.h>

namespace ceres_ed {
namespace {

// Falling asleep and waking up takes about this long. A thread therefore waits as long before it
// sleeps, so that all threads are awake when loops follow one another closely.
constexpr std::chrono::microseconds kPatience(50);

void Pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Waits a short time for `condition`. Returns false if it does not become true.
template <typename Condition>
bool AwaitBriefly(Condition condition) {
  static const bool has_one_core = std::thread::hardware_concurrency() == 1;
  if (has_one_core) return condition();
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {
    for (int i = 0; i < 16; ++i) {
      if (condition()) return true;
      Pause();
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

// True in a thread that is running a task.
thread_local bool within_task = false;

// The helpers of one calling thread.
class ThreadTeam {
 public:
  ThreadTeam() = default;
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  ~ThreadTeam() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  void Run(int num_tasks, const std::function<void(int)>& task) {
    Grow(num_tasks - 1);
    int num_wanted = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      task_ = &task;
      num_tasks_ = num_tasks;
      unfinished_ = num_tasks;
      open_ = num_tasks;
      num_wanted = std::min(num_asleep_, num_tasks - 1);
    }
    for (int i = 0; i < num_wanted; ++i) wake_.notify_one();
    within_task = true;
    while (TakeOne()) {
    }
    within_task = false;
    const auto is_done = [this] { return unfinished_ == 0; };
    if (AwaitBriefly(is_done)) return;
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait(lock, is_done);
  }

 private:
  // Creates helpers until there are `count`, or until the system can't create more.
  void Grow(int count) {
    try {
      while (static_cast<int>(helpers_.size()) < count) helpers_.emplace_back([this] { Help(); });
    } catch (const std::system_error&) {
      // The existing helpers and the caller do all tasks.
    }
  }

  // The loop of a helper: runs tasks, and sleeps when there are none.
  void Help() {
    within_task = true;
    const auto is_called = [this] { return stop_ || open_ > 0; };
    while (!stop_) {
      while (TakeOne()) {
      }
      if (AwaitBriefly(is_called)) continue;
      std::unique_lock<std::mutex> lock(mutex_);
      ++num_asleep_;
      wake_.wait(lock, is_called);
      --num_asleep_;
    }
  }

  // Runs the next task. Returns false if all tasks are taken.
  bool TakeOne() {
    const std::function<void(int)>* task = nullptr;
    int index = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (open_ == 0) return false;
      index = num_tasks_ - open_--;
      task = task_;
    }
    (*task)(index);
    if (--unfinished_ == 0) {
      // The lock keeps this from falling between the caller's test of the number and its sleep.
      const std::lock_guard<std::mutex> lock(mutex_);
      done_.notify_one();
    }
    return true;
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  // The current loop. It is changed under the lock; `open_` and `stop_` are also read without it.
  const std::function<void(int)>* task_ = nullptr;
  int num_tasks_ = 0;
  // The number of tasks that nobody has taken, and the number of those that are not done.
  std::atomic<int> open_{0};
  std::atomic<int> unfinished_{0};
  std::atomic<bool> stop_{false};
  int num_asleep_ = 0;
  std::vector<std::thread> helpers_;
};

// The team of a thread, created when it is first needed.
class OwnTeam {
 public:
  ~OwnTeam() { LeaveAfterFork(); }

  ThreadTeam& Get() {
    LeaveAfterFork();
    if (team_ == nullptr) {
      team_ = std::make_unique<ThreadTeam>();
      process_ = getpid();
    }
    return *team_;
  }

 private:
  // A forked child process has a copy of the team but not its threads, so the copy can be neither
  // used nor destroyed.
  void LeaveAfterFork() {
    if (team_ != nullptr && process_ != getpid()) static_cast<void>(team_.release());
  }

  std::unique_ptr<ThreadTeam> team_;
  pid_t process_ = 0;
};

}  // namespace

void RunTasks(int num_tasks, const std::function<void(int task)>& task) {
  if (num_tasks <= 1 || within_task) {
    for (int i = 0; i < num_tasks; ++i) task(i);
    return;
  }
  static thread_local OwnTeam team;
  team.Get().Run(num_tasks, task);
}

}  // namespace ceres_ed
