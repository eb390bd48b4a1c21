// The laws of what a registry says of an energy, and of its parameters.
#ifndef CERES_ED_TESTING_ENERGY_INFO_LAWS_H_
#define CERES_ED_TESTING_ENERGY_INFO_LAWS_H_

#include <ceres_ed/energy/energy_registry.h>

#include <map>
#include <string>
#include <vector>

namespace ceres_ed {

// Returns one sentence for each violated law of the registered energy `info`: those on its
// description and its parameters in energy_laws.h. `given` are parameters to create it with.
std::vector<std::string> CheckEnergyInfoLaws(const EnergyRegistry& registry,
                                             const EnergyInfo& info,
                                             const std::map<std::string, double>& given);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_ENERGY_INFO_LAWS_H_
