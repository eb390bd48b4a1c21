// What a registry has, for people to read.
#ifndef CERES_ED_ENERGY_ENERGY_LISTING_H_
#define CERES_ED_ENERGY_ENERGY_LISTING_H_

#include <ceres_ed/energy/energy_registry.h>

#include <string>

namespace ceres_ed {

// Returns every energy of `registry` in the order of their names, each with a blank line behind it:
// kind, what it wants, residual, unit, plugin, and its parameters with type, unit, range and
// default.
std::string ListEnergies(const EnergyRegistry& registry);

// The same in Markdown: a heading and, where there are parameters, a table an energy.
std::string ListEnergiesAsMarkdown(const EnergyRegistry& registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_LISTING_H_
