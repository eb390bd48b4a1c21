// The energies that a run can use: those of the library and those of plugins.
#ifndef CERES_ED_PIPELINE_ENERGIES_H_
#define CERES_ED_PIPELINE_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/pipeline/outcome.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Fills `registry` with the energies of the library and of `plugins` (paths, separated by ";"), and
// tries to create each of `specs`. Unless the outcome is done, the run must end. It is a usage
// error if an energy or a parameter does not exist, or if a value is bad; it is a bad input if a
// plugin cannot be loaded or cannot create its energy.
Outcome LoadEnergies(const std::string& plugins,
                     const std::vector<EnergySpec>& specs,
                     EnergyRegistry* registry);

// Returns a sentence for each plugin without a used energy, such as "plugin './mine.so' was loaded,
// and none of its energies is used".
std::vector<std::string> IdlePluginWarnings(const EnergyRegistry& registry,
                                            const std::vector<EnergySpec>& specs);

// Returns a sentence for each of `names`, such as "energy 'volume' has found nothing to add a
// residual to; it is: ...".
std::vector<std::string> IdleEnergyWarnings(const EnergyRegistry& registry,
                                            const std::vector<std::string>& names);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_ENERGIES_H_
