// A fitted surface with the error of each of its points.
#ifndef CERES_ED_IO_RESULTS_ERROR_CLOUD_H_
#define CERES_ED_IO_RESULTS_ERROR_CLOUD_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Writes `cloud` with the property `error` = errors[i] (in the unit of the input), and with colours
// from blue (0) over white to red (`full_scale` and above). `losses`, unless null, gets a sentence
// for each kind of thing that the format of the file can't represent.
Status WriteErrorCloud(const std::string& path,
                       const PointCloud& cloud,
                       const std::vector<double>& errors,
                       double full_scale,
                       std::vector<std::string>* losses = nullptr);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_ERROR_CLOUD_H_
