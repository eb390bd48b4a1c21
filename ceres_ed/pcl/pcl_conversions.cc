#include "ceres_ed/pcl/pcl_conversions.h"

#include <ceres_ed/pcl/cloud_document.h>

#include <cstdint>
#include <utility>

namespace ceres_ed {
namespace {

constexpr char kCloudName[] = "pcl::PCLPointCloud2";
constexpr char kMeshName[] = "pcl::PolygonMesh";
constexpr char kCorners[] = "vertex_indices";

PlyElement FacesOf(const pcl::PolygonMesh& mesh) {
  PlyElement faces;
  faces.name = "face";
  faces.count = mesh.polygons.size();
  PlyProperty corners = MakePlyList(kCorners, PlyType::kUint32, PlyType::kInt32);
  for (const pcl::Vertices& polygon : mesh.polygons) {
    corners.list_sizes.push_back(static_cast<std::uint32_t>(polygon.vertices.size()));
    corners.values.insert(corners.values.end(), polygon.vertices.begin(), polygon.vertices.end());
  }
  faces.properties.push_back(std::move(corners));
  return faces;
}

// The polygons of element 'face', which FromPcl or LoadCloud has checked.
std::vector<pcl::Vertices> PolygonsOf(const PlyDocument& document) {
  std::vector<pcl::Vertices> polygons;
  const PlyElement* const faces = document.Find("face");
  if (faces == nullptr) return polygons;
  const PlyProperty* corners = faces->Find(kCorners);
  if (corners == nullptr) corners = faces->Find("vertex_index");
  if (corners == nullptr || !corners->is_list) return polygons;
  std::size_t begin = 0;
  for (const std::uint32_t size : corners->list_sizes) {
    pcl::Vertices polygon;
    for (std::uint32_t i = 0; i < size; ++i) {
      polygon.vertices.push_back(static_cast<pcl::index_t>(corners->values[begin + i]));
    }
    begin += size;
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

}  // namespace

StatusOr<LoadedCloud> FromPcl(const pcl::PCLPointCloud2& cloud) {
  StatusOr<PlyDocument> document = DocumentFromPcl(kCloudName, cloud);
  if (!document.ok()) return document.status();
  return CloudFromDocument(kCloudName, *std::move(document));
}

StatusOr<LoadedCloud> FromPcl(const pcl::PolygonMesh& mesh) {
  StatusOr<PlyDocument> document = DocumentFromPcl(kMeshName, mesh.cloud);
  if (!document.ok()) return document.status();
  if (!mesh.polygons.empty()) document->elements.push_back(FacesOf(mesh));
  return CloudFromDocument(kMeshName, *std::move(document));
}

Status ToPcl(const LoadedCloud& original,
             const std::vector<Eigen::Vector3d>& points,
             const std::vector<Eigen::Vector3d>* normals,
             pcl::PCLPointCloud2* cloud) {
  const PlyDocument document =
      MoveVertices(original.document, original.vertex_of_point, points, normals);
  return PclFromDocument(kCloudName, document, /*single_precision=*/true, cloud);
}

Status ToPcl(const LoadedCloud& original,
             const std::vector<Eigen::Vector3d>& points,
             const std::vector<Eigen::Vector3d>* normals,
             pcl::PolygonMesh* mesh) {
  mesh->polygons = PolygonsOf(original.document);
  return ToPcl(original, points, normals, &mesh->cloud);
}

}  // namespace ceres_ed
