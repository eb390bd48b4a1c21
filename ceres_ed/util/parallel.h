// Loops over index ranges on several threads.
#ifndef CERES_ED_UTIL_PARALLEL_H_
#define CERES_ED_UTIL_PARALLEL_H_

#include <functional>

namespace ceres_ed {

// Runs body(begin, end) on contiguous ranges that together cover [0, count) once, and returns when
// all are done. The ranges depend on `num_threads` and `count` alone. So a body that writes only to
// its own indices gives the same bits with any number of threads. With one thread (or less), or a
// count of one, the function calls body(0, count) on the calling thread; with a count of zero it
// does nothing. If a body calls ParallelFor() itself, these inner ranges run one after another on
// its own thread. The threads are those of RunTasks() in thread_team.h and are reused by the next
// call. The body must not throw.
void ParallelFor(int num_threads, int count, const std::function<void(int begin, int end)>& body);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_PARALLEL_H_
