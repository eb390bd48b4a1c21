// What --plugin and --energy bring in.
#ifndef CERES_ED_APPS_SUPPORT_ENERGIES_H_
#define CERES_ED_APPS_SUPPORT_ENERGIES_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>

#include <string>
#include <vector>

#include <apps/support/program.h>

namespace ceres_ed {

// Fills `registry` with the energies of the library and of `plugins` (paths with ";" between them),
// and tries to make each of `specs`. Anything but done ends the program: a usage where the command
// line names an energy or a parameter that isn't there, or a bad value; a bad input where a plugin
// can't be loaded or can't make what it has.
Outcome LoadEnergies(const std::string& plugins,
                     const std::vector<EnergySpec>& specs,
                     EnergyRegistry* registry);

// "plugin './mine.so' was loaded, and none of its energies is used", a sentence a plugin.
std::vector<std::string> IdlePluginWarnings(const EnergyRegistry& registry,
                                            const std::vector<EnergySpec>& specs);

// "energy 'volume' has added no residuals here; it wants: ...", a sentence a name.
std::vector<std::string> IdleEnergyWarnings(const EnergyRegistry& registry,
                                            const std::vector<std::string>& names);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_ENERGIES_H_
