// ed_eval on a fitted surface and its target.
#ifndef CERES_ED_APPS_EVAL_PAIR_H_
#define CERES_ED_APPS_EVAL_PAIR_H_

#include <apps/eval_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {

// Measures the pair, prints the table and writes what the flags ask for.
Outcome EvaluatePair(const EvalSettings& settings);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_PAIR_H_
