#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/energy_registry.h>

#include <glog/logging.h>

namespace ceres_ed {

void RegisterBuiltinEnergies(EnergyRegistry* registry) {
  for (const auto register_energy : kRegisterEnergies) {
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
