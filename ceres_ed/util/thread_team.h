// Threads that are reused from one loop to the next.
#ifndef CERES_ED_UTIL_THREAD_TEAM_H_
#define CERES_ED_UTIL_THREAD_TEAM_H_

#include <functional>

namespace ceres_ed {

// Runs task(0) ... task(num_tasks - 1), each once, and returns when all are done. The calling
// thread and up to num_tasks - 1 helper threads take them in order. Whoever is free takes the next
// task, so a helper that wakes up late does not delay the others. The task must not throw.
//
// Each calling thread has helpers of its own, so that callers do not wait for one another. The
// helpers are created when they are first needed and end with the calling thread. Between calls
// they sleep. If a task calls RunTasks() itself, the inner tasks run on its own thread. A forked
// child process creates new helpers. If the system can't create threads, the caller runs all tasks.
void RunTasks(int num_tasks, const std::function<void(int task)>& task);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_THREAD_TEAM_H_
