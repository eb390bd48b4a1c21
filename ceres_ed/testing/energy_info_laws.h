// The laws of an energy's description in a registry, and of its parameters.
#ifndef CERES_ED_TESTING_ENERGY_INFO_LAWS_H_
#define CERES_ED_TESTING_ENERGY_INFO_LAWS_H_

#include <ceres_ed/energy/energy_registry.h>

#include <map>
#include <string>
#include <vector>

namespace ceres_ed {

// Returns one sentence for each violated law of the registered energy `info`. The laws are those on
// its description and its parameters in energy_laws.h. `given` are the parameters with which it is
// created.
std::vector<std::string> CheckEnergyInfoLaws(const EnergyRegistry& registry,
                                             const EnergyInfo& info,
                                             const std::map<std::string, double>& given);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_ENERGY_INFO_LAWS_H_
