// ed_eval on what ed_slam wrote for a sequence.
#ifndef CERES_ED_APPS_EVAL_SEQUENCE_H_
#define CERES_ED_APPS_EVAL_SEQUENCE_H_

#include <apps/eval_flags.h>
#include <apps/support/program.h>

namespace ceres_ed {

// Measures all that the two folders allow, prints the table and writes the report.
Outcome EvaluateSequence(const EvalSettings& settings);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_SEQUENCE_H_
