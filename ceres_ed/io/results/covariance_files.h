// camera_covariance.csv and map_covariance.ply: how well the frames of a sequence determine the
// camera and the points of the map.
#ifndef CERES_ED_IO_RESULTS_COVARIANCE_FILES_H_
#define CERES_ED_IO_RESULTS_COVARIANCE_FILES_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The following two functions return the first line of camera_covariance.csv and a row of it, with
// line ends: the frame, and the 21 entries of the upper triangle, row by row. `covariance` is that
// of camera to map, in metres and radians: the translation, then a rotation vector in the camera
// frame.
std::string CameraCovarianceHeader();
std::string CameraCovarianceRow(int frame, const Eigen::Matrix<double, 6, 6>& covariance);

// The covariances of the points of a map, in the map frame, in squared metres; NaN where nothing is
// known. The vectors have the same length.
struct MapCovariances {
  std::vector<int> ids;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Matrix3d> covariances;
};

// Writes x y z, id, xx xy xz yy yz zz, and std_dev, which is the root of the trace in metres. All
// of these figures are -1 where nothing is known. The error gives the system's reason.
Status WriteMapCovariances(const std::string& path, const MapCovariances& map);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_COVARIANCE_FILES_H_
