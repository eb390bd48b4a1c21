// PCD files by PCL, for programs that load this module when such a file is named.
#include <ceres_ed/io/mesh/mesh_module.h>
#include <ceres_ed/pcl/cloud_document.h>
#include <ceres_ed/pcl/pcd_reader.h>
#include <ceres_ed/version.h>

#include <exception>
#include <sstream>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

namespace ceres_ed {
namespace {

constexpr char kViewpoint[] = "viewpoint ";

// Position and rotation as PCD's header has them: x y z, and qw qx qy qz.
std::string FormatViewpoint(const PcdCloud& view) {
  std::ostringstream text;
  text.precision(9);
  text << kViewpoint << view.origin.head<3>().transpose() << ' ' << view.orientation.w() << ' '
       << view.orientation.vec().transpose();
  return text.str();
}

PcdCloud FindViewpoint(const PlyDocument& document) {
  for (const std::string& line : document.obj_info) {
    if (line.rfind(kViewpoint, 0) != 0) continue;
    std::istringstream text(line.substr(sizeof(kViewpoint) - 1));
    PcdCloud view;
    float* const q = view.orientation.coeffs().data();
    text >> view.origin[0] >> view.origin[1] >> view.origin[2] >> q[3] >> q[0] >> q[1] >> q[2];
    if (text) return view;
  }
  return {};
}

Status ReadPcdFile(const std::string& path, PlyDocument* document) {
  const StatusOr<PcdCloud> file = ReadPcdCloud(path);
  if (!file.ok()) return file.status();
  StatusOr<PlyDocument> read = DocumentFromPcl(path, file->cloud);
  if (!read.ok()) return read.status();
  *document = *std::move(read);
  document->obj_info.push_back(FormatViewpoint(*file));
  return Status::Ok();
}

Status EncodePcd(const std::string& path, const PlyDocument& document, std::string* bytes) {
  for (const PlyElement& element : document.elements) {
    if (element.name == "vertex" || element.count == 0) continue;
    return Status::Error(path + ": a PCD file holds points alone, and there are " +
                         std::to_string(element.count) + " rows of element '" + element.name +
                         "', expected a name that ends in .ply");
  }
  pcl::PCLPointCloud2 cloud;
  Status status = PclFromDocument(path, document, /*single_precision=*/false, &cloud);
  if (!status.ok()) return status;
  const PcdCloud view = FindViewpoint(document);
  try {
    *bytes = pcl::PCDWriter().generateHeaderBinary(cloud, view.origin, view.orientation);
  } catch (const std::exception& error) {
    return Status::Error(path + ": PCL cannot write it: " + error.what());
  }
  *bytes += "DATA binary\n";
  bytes->append(cloud.data.begin(), cloud.data.end());
  return Status::Ok();
}

}  // namespace
}  // namespace ceres_ed

extern "C" [[gnu::visibility("default")]] const ceres_ed::MeshModule* ceres_ed_mesh_module() {
  static const ceres_ed::MeshModule module = {
      CERES_ED_VERSION_STRING, ceres_ed::ReadPcdFile, ceres_ed::EncodePcd};
  return &module;
}
