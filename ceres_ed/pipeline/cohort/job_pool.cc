#include "ceres_ed/pipeline/cohort/job_pool.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace ceres_ed {
namespace {

constexpr std::chrono::milliseconds kWatchPeriod(100);

// The jobs and their order, for all threads.
class JobQueue {
 public:
  JobQueue(const std::vector<std::size_t>& needs, std::size_t memory)
      : needs_(needs), memory_(memory) {}

  // Waits until the next job may begin, and returns its number; -1 if there is none.
  int Take() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return IsOver() || Fits(needs_[next_]); });
    if (IsOver()) return -1;
    used_ += needs_[next_];
    ++at_work_;
    return next_++;
  }

  void End(int job) {
    const std::lock_guard<std::mutex> lock(mutex_);
    used_ -= needs_[job];
    --at_work_;
    ++ended_;
    changed_.notify_all();
  }

  void Stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_stopped_ = true;
    changed_.notify_all();
  }

  // Waits for a while, or until all is done. Returns whether it is.
  bool Wait(int* ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool done =
        changed_.wait_for(lock, kWatchPeriod, [this] { return IsOver() && at_work_ == 0; });
    *ended = ended_;
    return done;
  }

 private:
  bool IsOver() const { return is_stopped_ || next_ == static_cast<int>(needs_.size()); }
  bool Fits(std::size_t need) const {
    return memory_ == 0 || at_work_ == 0 || used_ + need <= memory_;
  }

  const std::vector<std::size_t>& needs_;
  const std::size_t memory_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int next_ = 0;
  int at_work_ = 0;
  int ended_ = 0;
  std::size_t used_ = 0;
  bool is_stopped_ = false;
};

}  // namespace

int RunJobs(const std::vector<std::size_t>& needs,
            const JobPoolOptions& options,
            const std::function<void(int job)>& work,
            const std::function<bool(int ended)>& watch) {
  JobQueue queue(needs, options.memory);
  const int count = std::min<int>(std::max(1, options.threads), static_cast<int>(needs.size()));
  std::vector<std::thread> threads;
  threads.reserve(count);
  for (int t = 0; t < count; ++t) {
    threads.emplace_back([&] {
      for (int job = queue.Take(); job >= 0; job = queue.Take()) {
        work(job);
        queue.End(job);
      }
    });
  }
  int ended = 0;
  bool done = false;
  while (!done) {
    done = queue.Wait(&ended);
    if (!watch(ended)) queue.Stop();
  }
  for (std::thread& thread : threads) thread.join();
  return ended;
}

}  // namespace ceres_ed
