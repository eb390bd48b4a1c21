// Lists of the energies in a registry, for people to read.
#ifndef CERES_ED_ENERGY_ENERGY_LISTING_H_
#define CERES_ED_ENERGY_ENERGY_LISTING_H_

#include <ceres_ed/energy/energy_registry.h>

#include <string>

namespace ceres_ed {

// Returns a text on every energy of `registry`, sorted by name and separated by blank lines: kind,
// aim, residual, unit, plugin, and its parameters with type, unit, range and default.
std::string ListEnergies(const EnergyRegistry& registry);

// Returns the same in Markdown: for each energy a heading and, if it has parameters, a table.
std::string ListEnergiesAsMarkdown(const EnergyRegistry& registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_LISTING_H_
