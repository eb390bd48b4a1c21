// The energies that a run can use: those of the library and those of plugins.
#ifndef CERES_ED_PIPELINE_ENERGIES_H_
#define CERES_ED_PIPELINE_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/pipeline/outcome.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Fills `registry` with the energies of the library and of `plugins` (paths with ";" between them),
// and tries to make each of `specs`. Anything but done ends the run: a usage where the user names
// an energy or a parameter that isn't there, or a bad value; a bad input where a plugin can't be
// loaded or can't make what it has.
Outcome LoadEnergies(const std::string& plugins,
                     const std::vector<EnergySpec>& specs,
                     EnergyRegistry* registry);

// Returns "plugin './mine.so' was loaded, and none of its energies is used", a sentence for each
// such plugin.
std::vector<std::string> IdlePluginWarnings(const EnergyRegistry& registry,
                                            const std::vector<EnergySpec>& specs);

// Returns "energy 'volume' has found nothing to add a residual to; it is: ...", a sentence for each
// of `names`.
std::vector<std::string> IdleEnergyWarnings(const EnergyRegistry& registry,
                                            const std::vector<std::string>& names);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_ENERGIES_H_
