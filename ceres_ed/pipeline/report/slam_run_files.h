// The files of a run of ed_slam, as there is to see of them.
#ifndef CERES_ED_PIPELINE_REPORT_SLAM_RUN_FILES_H_
#define CERES_ED_PIPELINE_REPORT_SLAM_RUN_FILES_H_

#include <ceres_ed/pipeline/report/run_reader.h>
#include <ceres_ed/report/html/sequence_page.h>

#include <string>
#include <vector>

namespace ceres_ed {

struct SlamRunView {
  SequenceView view;
  // A sentence for each file that is missing or cannot be used; the scene has them as notes.
  std::vector<std::string> missing;
};

// Reads frames.csv, the trajectory, live clouds, the map, tracks, and the pictures and the truth of
// the sequence, as far as they are there, beside the report of a run of ed_slam. The sequence is
// the one that the report names, or `sequence` if it is not empty. At most kMaxMoments frames are
// read. With `with_truth` the points of the map are compared with the truth of the sequence.
SlamRunView ReadSlamRun(const FinishedRun& run, const std::string& sequence, bool with_truth);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_REPORT_SLAM_RUN_FILES_H_
