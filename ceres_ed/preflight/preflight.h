// Looks at the inputs of a fit before it begins, and names each fault with its fix.
#ifndef CERES_ED_PREFLIGHT_PREFLIGHT_H_
#define CERES_ED_PREFLIGHT_PREFLIGHT_H_

#include <ceres_ed/preflight/finding.h>

#include <functional>
#include <vector>

namespace ceres_ed {

// Returns the findings of all checks of one cloud (check_table.h), in the order of the table.
// The cloud must have a point, and its points must be finite. `should_stop` is asked before each
// check; the rest is left out if it returns true.
std::vector<Finding> InspectCloud(const Specimen& specimen,
                                  const std::function<bool()>& should_stop = {});

// Returns the findings of all checks of two clouds together; `should_stop` as above.
std::vector<Finding> InspectPair(const Specimen& source,
                                 const Specimen& target,
                                 const std::function<bool()>& should_stop = {});

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_PREFLIGHT_H_
