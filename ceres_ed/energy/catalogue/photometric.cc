// Moves warped points to where the target is as bright as they are.
//
// The brightness is taken as linear around a matched point. A pair that is farther apart than a
// quarter of a wavelength of the texture therefore gives a wrong direction. The same is true for
// pairs beyond the border of a cloud without triangles, whose borders are unknown. In these cases
// limit MatchingOptions::max_distance, or give the energy a robust loss.
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/point_energy.h>

#include <optional>

#include <cost_functions/photometric_cost.h>

namespace ceres_ed {

Status RegisterPhotometric(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "photometric";
  info.summary =
      "warped points come to where the target is as bright as they are (both clouds need colours)";
  info.equation = "I_t + g . (v~ - v^) - I_s (Park et al. 2017)";
  info.unit = "intensity";
  info.kind = EnergyKind::kObservation;
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachDetailedMatch([](const Correspondence& c,
                                   const MatchDetail& detail) -> std::optional<PhotometricCost> {
      if (!detail.HasIntensities()) return std::nullopt;
      return PhotometricCost(
          c.target, detail.target_intensity, detail.intensity_gradient, detail.source_intensity);
    });
  });
}

}  // namespace ceres_ed
