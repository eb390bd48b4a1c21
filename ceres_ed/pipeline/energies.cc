#include "ceres_ed/pipeline/energies.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/plugin/plugin_loader.h>

#include <set>

namespace ceres_ed {

Outcome LoadEnergies(const std::string& plugins,
                     const std::vector<EnergySpec>& specs,
                     EnergyRegistry* registry) {
  RegisterBuiltinEnergies(registry);
  if (Status status = LoadPlugins(plugins, registry); !status.ok()) {
    return Outcome::BadInput(status);
  }
  for (const EnergySpec& spec : specs) {
    const EnergyInfo* info = registry->Find(spec.name);
    const Status given = info == nullptr ? registry->Create(spec.name, spec.parameters).status()
                                         : ParameterValues::Create(*info, spec.parameters).status();
    if (!given.ok()) return Outcome::Usage("--energy: " + given.message());
    const auto term = registry->Create(spec.name, spec.parameters);
    if (!term.ok()) return Outcome::BadInput(term.status());
  }
  return Outcome::Done();
}

std::vector<std::string> IdlePluginWarnings(const EnergyRegistry& registry,
                                            const std::vector<EnergySpec>& specs) {
  std::set<std::string> plugins;
  for (const EnergyInfo* info : registry.List()) plugins.insert(info->origin);
  plugins.erase("");
  for (const EnergySpec& spec : specs) {
    const EnergyInfo* info = registry.Find(spec.name);
    if (info != nullptr) plugins.erase(info->origin);
  }
  std::vector<std::string> warnings;
  warnings.reserve(plugins.size());
  for (const std::string& plugin : plugins) {
    warnings.push_back(plugin + " was loaded, and none of its energies is used: expected one in " +
                       "--energy");
  }
  return warnings;
}

std::vector<std::string> IdleEnergyWarnings(const EnergyRegistry& registry,
                                            const std::vector<std::string>& names) {
  std::vector<std::string> warnings;
  for (const std::string& name : names) {
    const EnergyInfo* info = registry.Find(name);
    warnings.push_back("energy '" + name + "' has found nothing to add a residual to; it is: " +
                       (info != nullptr ? info->summary : "unknown"));
  }
  return warnings;
}

}  // namespace ceres_ed
