// The command line of ed_eval.
#ifndef CERES_ED_APPS_EVAL_FLAGS_H_
#define CERES_ED_APPS_EVAL_FLAGS_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// What the user asked for: either a pair or a sequence, with the paths of the other one empty.
struct EvalSettings {
  // A pair.
  std::string fitted;
  std::string target;
  std::string source;
  std::string truth;
  std::string error_ply;
  // A sequence.
  std::string sequence;
  std::string result;
  // Either.
  std::string report;

  bool is_sequence() const { return !sequence.empty(); }
};

// Returns the flags and positional arguments; an error where they mix the two uses, or name half of
// one.
StatusOr<EvalSettings> ReadEvalFlags(const std::vector<std::string>& arguments);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_FLAGS_H_
