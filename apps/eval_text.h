// The tables that ed_eval prints.
#ifndef CERES_ED_APPS_EVAL_TEXT_H_
#define CERES_ED_APPS_EVAL_TEXT_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_figures.h>

#include <string>

namespace ceres_ed {

// Returns a table of a pair: one row a distance, in the unit of the input, with the mean in percent
// of the target's diagonal behind it.
std::string EvaluationTable(const Evaluation& evaluation);

// Returns tables of a sequence, in millimetres, pixels and degrees: every part that there is, a
// dozen frames, and the sum over all of them.
std::string SequenceTables(const SequenceFigures& figures);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_TEXT_H_
