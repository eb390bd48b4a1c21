// What an evaluation of files is asked to do.
#ifndef CERES_ED_PIPELINE_EVALUATE_EVALUATE_SETTINGS_H_
#define CERES_ED_PIPELINE_EVALUATE_EVALUATE_SETTINGS_H_

#include <ceres_ed/pipeline/run_flag.h>

#include <string>

namespace ceres_ed {

// Either a pair or a sequence, with the paths of the other one empty.
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
  // For the report.
  RunFlags flags;

  bool is_sequence() const { return !sequence.empty(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_EVALUATE_SETTINGS_H_
