#include "ceres_ed/io/mesh/pcd_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/mesh/mesh_module.h>
#include <ceres_ed/io/text.h>

#include <fstream>
#include <utility>

namespace ceres_ed {
namespace {

StatusOr<const MeshModule*> LoadPclModule(const std::string& path) {
  StatusOr<const MeshModule*> module = LoadMeshModule(CERES_ED_PCL_MODULE);
  if (module.ok()) return module;
  return Status::Error(path +
                       ": PCD files need ceres_ed's module for PCL: install the package "
                       "ceres-ed-pcl, or libpcl-dev and build again (" +
                       module.status().message() + ")");
}

}  // namespace

StatusOr<PlyDocument> ReadPcd(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &file);
  if (!size.ok()) return size.status();
  const StatusOr<const MeshModule*> module = LoadPclModule(path);
  if (!module.ok()) return module.status();
  PlyDocument document;
  Status status = (*module)->read(path, &document);
  if (!status.ok()) return status;
  return document;
}

Status WritePcd(const std::string& path, const PlyDocument& document) {
  const StatusOr<const MeshModule*> module = LoadPclModule(path);
  if (!module.ok()) return module.status();
  std::string bytes;
  Status status = (*module)->encode(path, document, &bytes);
  return status.ok() ? WriteFileAtomically(path, bytes) : status;
}

}  // namespace ceres_ed
