// The energies that come with the library.
#ifndef CERES_ED_ENERGY_BUILTIN_ENERGIES_H_
#define CERES_ED_ENERGY_BUILTIN_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>

namespace ceres_ed {

// Adds rotation, regularization, node_prior, pose_prior, point_to_plane, point_to_point and
// landmark. CHECK-fails when one of these names is taken: call it first.
void RegisterBuiltinEnergies(EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_BUILTIN_ENERGIES_H_
