#include "ceres_ed/energy/builtin_energies.h"

#include <ceres_ed/energy/catalogue/catalogue.h>

namespace ceres_ed {

void RegisterBuiltinEnergies(EnergyRegistry* registry) {
  using RegisterFunction = Status(EnergyRegistry*);
  constexpr RegisterFunction* kEnergies[] = {RegisterRotation,
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
  for (RegisterFunction* const register_energy : kEnergies) {
    const Status status = register_energy(registry);
    CHECK(status.ok()) << status.message();
  }
}

EnergyRegistry BuiltinEnergies() {
  EnergyRegistry registry;
  RegisterBuiltinEnergies(&registry);
  return registry;
}

}  // namespace ceres_ed
