// The report.json of the tracking of a sequence.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_REPORT_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_REPORT_H_

#include <ceres_ed/pipeline/slam/slam_observer.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns the contents of report.json. Lengths are in metres, times in seconds.
nlohmann::ordered_json SlamReport(const SlamRun& run);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_REPORT_H_
