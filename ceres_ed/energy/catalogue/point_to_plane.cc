// The distance of a warped point from the tangent plane of its matched target point.
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>

#include <cost_functions/point_to_plane_cost.h>

namespace ceres_ed {

Status RegisterPointToPlane(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "point_to_plane";
  info.summary = "warped points come to the tangent planes of their matched target points";
  info.equation = "n . (v~ - v^)";
  info.unit = "length";
  info.kind = EnergyKind::kObservation;
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachMatch(
        [](const Correspondence& c) { return PointToPlaneCost(c.target, c.normal); });
  });
}

}  // namespace ceres_ed
