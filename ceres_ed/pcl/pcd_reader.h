// PCD files, read without trust in what they promise.
#ifndef CERES_ED_PCL_PCD_READER_H_
#define CERES_ED_PCL_PCD_READER_H_

#include <ceres_ed/util/status.h>

#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <pcl/PCLPointCloud2.h>

namespace ceres_ed {

// A cloud, and from where it was seen.
struct PcdCloud {
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
};

// Returns the points of the PCD file `path`: ascii, binary or binary_compressed, of version 0.7 or
// one before it. Errors name the file, the line and what was expected. PCL's own reader takes the
// memory for all points while it reads the header, and crashes on some damaged files; here no
// memory is taken for points that the file cannot hold.
StatusOr<PcdCloud> ReadPcdCloud(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_PCL_PCD_READER_H_
