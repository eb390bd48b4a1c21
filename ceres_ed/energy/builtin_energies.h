// The energies that come with the library.
#ifndef CERES_ED_ENERGY_BUILTIN_ENERGIES_H_
#define CERES_ED_ENERGY_BUILTIN_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>

namespace ceres_ed {

// Returns a new registry with the energies of catalogue/.
EnergyRegistry BuiltinEnergies();

// Adds these energies to `registry`. Fails a CHECK if one of their names is taken, so call it
// before energies of your own are registered.
void RegisterBuiltinEnergies(EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_BUILTIN_ENERGIES_H_
