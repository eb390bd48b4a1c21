// The settings of an evaluation of files.
#ifndef CERES_ED_PIPELINE_EVALUATE_EVALUATE_SETTINGS_H_
#define CERES_ED_PIPELINE_EVALUATE_EVALUATE_SETTINGS_H_

#include <ceres_ed/pipeline/run_flag.h>

#include <string>

namespace ceres_ed {

// The settings for a pair or for a sequence. The paths of the other one are empty.
struct EvalSettings {
  // For a pair.
  std::string fitted;
  std::string target;
  std::string source;
  std::string truth;
  std::string error_ply;
  std::string calibration;
  // For a sequence.
  std::string sequence;
  std::string result;
  // For both.
  std::string report;
  std::string html;
  std::string png;
  // The flags of the program, for the report.
  RunFlags flags;

  bool is_sequence() const { return !sequence.empty(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_EVALUATE_SETTINGS_H_
