// Keeps a point at its rest position.
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>

#include <stdexcept>
#include <string>

#include <cost_functions/point_to_point_cost.h>

namespace ceres_ed {

Status RegisterPinnedVertex(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "pinned_vertex";
  info.summary = "a point of the source stays where the rigid placement puts it (fits)";
  info.equation = "v~ - v";
  info.unit = "length";
  info.kind = EnergyKind::kObservation;
  info.parameters = {IntegerParameter("point", 0, 2147483647, 0, "which of the source's points")};
  return registry->Register(info, [](const ParameterValues& values) {
    const int point = static_cast<int>(values.Get("point"));
    const auto add = [point](const EnergyContext& context, ResidualSink* sink) {
      const auto num_points = static_cast<int>(context.points->size());
      // The points of a tracker are those in view and are numbered anew in each frame, so a number
      // does not identify a point.
      if (context.has_camera || num_points == 0) return;
      if (point >= num_points) {
        throw std::invalid_argument("point " + std::to_string(point) + " is not there, expected " +
                                    "one of " + std::to_string(num_points));
      }
      const PointToPointCost pin((*context.points)[point]);
      AddPointResidual(context, point, pin, 1.0, sink);
    };
    return MakeEnergy(EnergyKind::kObservation, add);
  });
}

}  // namespace ceres_ed
