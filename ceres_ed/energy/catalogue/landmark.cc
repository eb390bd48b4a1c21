// Points that the user names come to the places that the user gives.
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>

#include <cost_functions/point_to_point_cost.h>

namespace ceres_ed {

Status RegisterLandmark(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "landmark";
  info.summary = "points that the user names come to the places that the user gives";
  info.equation = "v~ - v^ (Eq. 7)";
  info.unit = "length";
  info.kind = EnergyKind::kObservation;
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachLandmark([](const Correspondence& c) { return PointToPointCost(c.target); });
  });
}

}  // namespace ceres_ed
