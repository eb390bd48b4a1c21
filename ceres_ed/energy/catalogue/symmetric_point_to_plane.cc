// The distance of a warped point from its matched target point along the mean of both normals.
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>

#include <cost_functions/point_to_plane_cost.h>

namespace ceres_ed {
namespace {

// Returns (n_s + n_t) / 2. It is not of unit length, so pairs whose normals differ count less.
// Normals of clouds without triangles are known only up to sign, so n_s is turned to the side of
// n_t. If only one normal is known, the result is that one.
Eigen::Vector3d MeanNormal(const Correspondence& c, const MatchDetail& detail) {
  const Eigen::Vector3d& target =
      detail.target_normal.isZero(0.0) ? c.normal : detail.target_normal;
  const Eigen::Vector3d& source = detail.source_normal;
  if (source.isZero(0.0)) return target;
  if (target.isZero(0.0)) return source;
  return 0.5 * (target + (source.dot(target) < 0.0 ? -source : source));
}

}  // namespace

Status RegisterSymmetricPointToPlane(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "symmetric_point_to_plane";
  info.summary = "warped points come to their matched target points along the mean of both normals";
  info.equation = "(n_s + n) / 2 . (v~ - v^) (Rusinkiewicz 2019)";
  info.unit = "length";
  info.kind = EnergyKind::kObservation;
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachDetailedMatch([](const Correspondence& c, const MatchDetail& detail) {
      return PointToPlaneCost(c.target, MeanNormal(c, detail));
    });
  });
}

}  // namespace ceres_ed
