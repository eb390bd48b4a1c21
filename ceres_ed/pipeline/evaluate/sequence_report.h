// The report of the evaluation of a sequence.
#ifndef CERES_ED_PIPELINE_EVALUATE_SEQUENCE_REPORT_H_
#define CERES_ED_PIPELINE_EVALUATE_SEQUENCE_REPORT_H_

#include <ceres_ed/evaluation/sequence_figures.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns {"truth", "camera", "depth", "tracks_2d", "log"} in metres, pixels, degrees and seconds.
// A part that was not computed is null. "truth" and "depth" have a "summary" over the frames (mean,
// median and maximum of each figure of a frame) and all "frames"; the two alignments of "camera"
// and "tracks_2d" have their own figures and all "frames".
nlohmann::ordered_json SequenceReport(const SequenceFigures& figures);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_SEQUENCE_REPORT_H_
