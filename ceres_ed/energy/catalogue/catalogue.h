// The energies that come with the library, one file each. To add one: a functor in cost_functions/,
// a file here that registers it, and a line below and in builtin_energies.cc.
#ifndef CERES_ED_ENERGY_CATALOGUE_CATALOGUE_H_
#define CERES_ED_ENERGY_CATALOGUE_CATALOGUE_H_

#include <ceres_ed/energy/energy_registry.h>

namespace ceres_ed {

// Priors.
Status RegisterRotation(EnergyRegistry* registry);
Status RegisterRegularization(EnergyRegistry* registry);
Status RegisterNodePrior(EnergyRegistry* registry);
Status RegisterPosePrior(EnergyRegistry* registry);
Status RegisterLaplacian(EnergyRegistry* registry);
Status RegisterVolume(EnergyRegistry* registry);
Status RegisterTemporalSmoothness(EnergyRegistry* registry);

// Observations.
Status RegisterPointToPlane(EnergyRegistry* registry);
Status RegisterPointToPoint(EnergyRegistry* registry);
Status RegisterLandmark(EnergyRegistry* registry);
Status RegisterPinnedVertex(EnergyRegistry* registry);
Status RegisterSymmetricPointToPlane(EnergyRegistry* registry);
Status RegisterPhotometric(EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_CATALOGUE_CATALOGUE_H_
