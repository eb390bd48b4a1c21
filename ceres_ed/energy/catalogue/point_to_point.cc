// E_data of the paper (Eq. 7).
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>

#include <cost_functions/point_to_point_cost.h>

namespace ceres_ed {

Status RegisterPointToPoint(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "point_to_point";
  info.summary = "warped points come to their matched target points";
  info.equation = "v~ - v^ (Eq. 7)";
  info.unit = "length";
  info.kind = EnergyKind::kObservation;
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachMatch([](const Correspondence& c) { return PointToPointCost(c.target); });
  });
}

}  // namespace ceres_ed
