// Threads that stay for the next loop.
#ifndef CERES_ED_UTIL_THREAD_TEAM_H_
#define CERES_ED_UTIL_THREAD_TEAM_H_

#include <functional>

namespace ceres_ed {

// Runs task(0) ... task(num_tasks - 1), each once, and returns when all are done. The calling
// thread and up to num_tasks - 1 helpers take them in order: whoever is free takes the next, so
// that a helper that the system is slow to wake holds up nobody. The task must not throw.
//
// Each calling thread has helpers of its own, made when they are first wanted and gone with it:
// callers don't wait for one another. Between calls helpers sleep. Within a task further calls run
// on the thread that makes them. A forked child makes new helpers; where the system gives none, the
// caller does all.
void RunTasks(int num_tasks, const std::function<void(int task)>& task);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_THREAD_TEAM_H_
