#include "ceres_ed/registration/intrinsic/map_quality.h"

#include <ceres_ed/geometry/triangle_area.h>

#include <array>

namespace ceres_ed {
namespace {

// A vertex returns if it comes back within this many spacings.
constexpr double kReturns = 3.0;

}  // namespace

std::vector<double> ReturnDistances(const CoarseMesh& source, const PointMap& map) {
  std::vector<double> distances(source.size());
  for (int i = 0; i < source.size(); ++i) {
    distances[i] =
        (source.positions[map.back[map.forth[i]]] - source.positions[i]).norm() / source.spacing;
  }
  return distances;
}

MapQuality MeasureMap(const CoarseMesh& source, const CoarseMesh& target, const PointMap& map) {
  const std::vector<Eigen::Vector3d> normals = CoarseNormals(target);
  MapQuality quality;
  int kept = 0;
  int turned = 0;
  for (const std::array<int, 3>& t : source.triangles) {
    const std::array<int, 3> image = {map.forth[t[0]], map.forth[t[1]], map.forth[t[2]]};
    const Eigen::Vector3d outward = normals[image[0]] + normals[image[1]] + normals[image[2]];
    const double side = AreaVector(target.positions, image).dot(outward);
    kept += side > 0.0;
    turned += side < 0.0;
  }
  if (kept + turned > 0) quality.orientation = static_cast<double>(kept) / (kept + turned);
  int returning = 0;
  for (const double distance : ReturnDistances(source, map)) returning += distance < kReturns;
  quality.returning = static_cast<double>(returning) / source.size();
  return quality;
}

}  // namespace ceres_ed
