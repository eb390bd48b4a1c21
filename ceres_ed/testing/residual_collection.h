// Collects the residuals of an energy without a problem.
#ifndef CERES_ED_TESTING_RESIDUAL_COLLECTION_H_
#define CERES_ED_TESTING_RESIDUAL_COLLECTION_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/testing/cost_laws.h>

#include <memory>
#include <string>
#include <vector>

#include <ceres/cost_function.h>

namespace ceres_ed {

// A residual as it was added by an energy.
struct CollectedResidual {
  std::unique_ptr<ceres::CostFunction> cost;
  std::vector<BlockRef> blocks;
  double weight = 1.0;
};

// Returns the residuals that `energy` adds for `context`, in order and without any check.
std::vector<CollectedResidual> CollectResiduals(const EnergyTerm& energy,
                                                const EnergyContext& context);

// Returns the parameter blocks of a residual at `state`; its block indices must be in range.
ParameterBlocks BlocksAt(const CollectedResidual& residual, const DeformationState& state);

// Returns what is wrong with a residual on a graph of `num_nodes` nodes, with or without a camera:
// it has no cost function, a bad weight, or blocks that do not exist, do not fit or occur twice.
// Empty if nothing is wrong.
std::string BlockFault(const CollectedResidual& residual, int num_nodes, bool has_camera);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_RESIDUAL_COLLECTION_H_
