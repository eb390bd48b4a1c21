// Names of what fits and trackers share, as the programs' flags have them.
#ifndef CERES_ED_PYTHON_CHOICES_H_
#define CERES_ED_PYTHON_CHOICES_H_

#include <ceres_ed/python/options.h>
#include <ceres_ed/solver/strategy.h>

namespace ceres_ed::python {

inline constexpr Choice<SolveMode> kModes[] = {{"batch", SolveMode::kBatch},
                                               {"two_level", SolveMode::kTwoLevel},
                                               {"marginal", SolveMode::kMarginal}};
inline constexpr Choice<SeamEdges> kBoundaries[] = {{"keep", SeamEdges::kKeep},
                                                    {"cut", SeamEdges::kCut}};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_CHOICES_H_
