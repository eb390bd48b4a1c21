// Loads energies from shared objects.
#ifndef CERES_ED_PLUGIN_PLUGIN_LOADER_H_
#define CERES_ED_PLUGIN_PLUGIN_LOADER_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Loads the shared object `path` (see plugin_abi.h), which adds its energies to `registry`. A path
// without a slash is a file in the working directory. The object stays loaded until the process
// ends, since the registry has pointers to its functions.
//
// The error names the file and the reason: it can't be read, is no shared object, is no plugin, was
// built against another ceres_ed, Ceres, Eigen or alignment (with both versions), or its register
// function failed or threw. Before the versions are known to agree, no code of the plugin runs
// except its static initializers.
Status LoadPlugin(const std::string& path, EnergyRegistry* registry);

// Loads several plugins, whose paths are separated by ";". An empty `paths` loads none. The error
// is that of the first plugin that can't be loaded.
Status LoadPlugins(const std::string& paths, EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_PLUGIN_PLUGIN_LOADER_H_
