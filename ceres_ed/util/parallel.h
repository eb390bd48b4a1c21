// Loops over index ranges on several threads.
#ifndef CERES_ED_UTIL_PARALLEL_H_
#define CERES_ED_UTIL_PARALLEL_H_

#include <functional>

namespace ceres_ed {

// Runs body(begin, end) on contiguous ranges that cover [0, count) once, and returns when all are
// done. The ranges depend on the two numbers alone, so that a body which writes to its own indices
// gives the same bits at any thread count. One thread (or less), or a count of one, runs inline as
// body(0, count); an empty count calls nothing. Within a body the ranges of a further call run one
// by one on the thread that makes it. Threads are those of RunTasks() in thread_team.h: they stay
// for the next call. The body must not throw.
void ParallelFor(int num_threads, int count, const std::function<void(int begin, int end)>& body);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_PARALLEL_H_
