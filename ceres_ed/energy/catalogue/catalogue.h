// The energies that come with the library, one file each. To add one, write a file here that
// registers it, with its functor in cost_functions/ or in the file itself, and add its function to
// this header.
#ifndef CERES_ED_ENERGY_CATALOGUE_CATALOGUE_H_
#define CERES_ED_ENERGY_CATALOGUE_CATALOGUE_H_

#include <ceres_ed/energy/energy_registry.h>

namespace ceres_ed {

// Each function adds the energy of its name to `registry`, and returns an error if the name is
// taken.

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

// All of the above.
inline constexpr Status (*kRegisterEnergies[])(EnergyRegistry* registry) = {
    RegisterRotation,
    RegisterRegularization,
    RegisterNodePrior,
    RegisterPosePrior,
    RegisterLaplacian,
    RegisterVolume,
    RegisterTemporalSmoothness,
    RegisterPointToPlane,
    RegisterPointToPoint,
    RegisterLandmark,
    RegisterPinnedVertex,
    RegisterSymmetricPointToPlane,
    RegisterPhotometric};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_CATALOGUE_CATALOGUE_H_
