// The energies that come with the library.
#ifndef CERES_ED_ENERGY_BUILTIN_ENERGIES_H_
#define CERES_ED_ENERGY_BUILTIN_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>

namespace ceres_ed {

// Returns a registry that has the energies of catalogue/.
EnergyRegistry BuiltinEnergies();

// Adds them to a registry: CHECK-fails when one of their names is taken. Call it first.
void RegisterBuiltinEnergies(EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_BUILTIN_ENERGIES_H_
