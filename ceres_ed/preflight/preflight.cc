#include "ceres_ed/preflight/preflight.h"

#include <ceres_ed/preflight/check_table.h>

namespace ceres_ed {

std::vector<Finding> InspectCloud(const Specimen& specimen) {
  std::vector<Finding> findings;
  for (const CloudCheck check : kCloudChecks) check(specimen, &findings);
  return findings;
}

std::vector<Finding> InspectPair(const Specimen& source, const Specimen& target) {
  std::vector<Finding> findings;
  for (const PairCheck check : kPairChecks) check(source, target, &findings);
  return findings;
}

}  // namespace ceres_ed
