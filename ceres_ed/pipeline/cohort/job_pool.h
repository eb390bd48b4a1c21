// Jobs on several threads, within a bound of memory.
#ifndef CERES_ED_PIPELINE_COHORT_JOB_POOL_H_
#define CERES_ED_PIPELINE_COHORT_JOB_POOL_H_

#include <cstddef>
#include <functional>
#include <vector>

namespace ceres_ed {

struct JobPoolOptions {
  int threads = 1;
  // What all jobs at work may need together, in bytes; 0 = unlimited. One job always runs.
  std::size_t memory = 0;
};

// Runs work(i) for all i < needs.size(), in this order but for several at a time, each on one of
// `threads` threads. Job i needs needs[i] bytes: it begins when so much is free. `watch` is called
// on the calling thread about ten times a second, and after the last job, with the number of jobs
// that have ended; once it returns false, no job begins any more. Returns the number of jobs that
// have ended. `work` must not throw.
int RunJobs(const std::vector<std::size_t>& needs,
            const JobPoolOptions& options,
            const std::function<void(int job)>& work,
            const std::function<bool(int ended)>& watch);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_JOB_POOL_H_
