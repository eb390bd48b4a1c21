// Looks at the inputs of a fit before it begins, and names each fault with its fix.
#ifndef CERES_ED_PREFLIGHT_PREFLIGHT_H_
#define CERES_ED_PREFLIGHT_PREFLIGHT_H_

#include <ceres_ed/preflight/finding.h>

#include <vector>

namespace ceres_ed {

// Returns the findings of all checks of one cloud (check_table.h), in the order of the table.
// The cloud must have a point, and its points must be finite.
std::vector<Finding> InspectCloud(const Specimen& specimen);

// Returns the findings of all checks of two clouds together.
std::vector<Finding> InspectPair(const Specimen& source, const Specimen& target);

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_PREFLIGHT_H_
