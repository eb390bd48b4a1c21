#include "ceres_ed/io/mesh/pcd_file.h"

#include <ceres_ed/io/mesh/mesh_module.h>

namespace ceres_ed {
namespace {

constexpr MeshModuleFile kModule = {
    CERES_ED_PCL_MODULE, "PCD", "PCL", "ceres-ed-pcl", "libpcl-dev"};

}  // namespace

StatusOr<PlyDocument> ReadPcd(const std::string& path) { return ReadByModule(kModule, path); }

Status WritePcd(const std::string& path, const PlyDocument& document) {
  return WriteByModule(kModule, path, document);
}

}  // namespace ceres_ed
