// Energies from shared objects.
#ifndef CERES_ED_PLUGIN_PLUGIN_LOADER_H_
#define CERES_ED_PLUGIN_PLUGIN_LOADER_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns ok when the shared object `path` (see plugin_abi.h) has added its energies to `registry`.
// A path without a slash is a file of the working directory. The object stays loaded until the
// process ends, since the registry holds functions of it.
//
// Errors name the file: it cannot be read, is no shared object, is no plugin, was built against
// another ceres_ed, Ceres, Eigen or alignment (which one, there and here), or its register function
// failed or threw. Nothing of the plugin runs before the versions are known to agree, but static
// initializers.
Status LoadPlugin(const std::string& path, EnergyRegistry* registry);

// The same for several, with ";" between their paths; none where `paths` is empty. Error: of the
// first that can't be loaded.
Status LoadPlugins(const std::string& paths, EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_PLUGIN_PLUGIN_LOADER_H_
