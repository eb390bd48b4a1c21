#include "ceres_ed/preflight/preflight.h"

#include <ceres_ed/preflight/check_table.h>

namespace ceres_ed {

std::vector<Finding> InspectCloud(const Specimen& specimen,
                                  const std::function<bool()>& should_stop) {
  std::vector<Finding> findings;
  for (const CloudCheck check : kCloudChecks) {
    if (should_stop && should_stop()) break;
    check(specimen, &findings);
  }
  return findings;
}

std::vector<Finding> InspectPair(const Specimen& source,
                                 const Specimen& target,
                                 const std::function<bool()>& should_stop) {
  std::vector<Finding> findings;
  for (const PairCheck check : kPairChecks) {
    if (should_stop && should_stop()) break;
    check(source, target, &findings);
  }
  return findings;
}

}  // namespace ceres_ed
