// Lets edges yield where tissue slides along tissue.
#ifndef CERES_ED_SLAM_LEVELS_EDGE_WEIGHTS_H_
#define CERES_ED_SLAM_LEVELS_EDGE_WEIGHTS_H_

#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

namespace ceres_ed {

// Sets the weights alpha_jk (Eq. 6) of the edges that leave `nodes`, from their present strain e,
// the length of the residual of E_reg without a weight (map units):
//   alpha_jk = 1 / (1 + (e / s)^2)^2,  s = `yield_strain` > 0
// Edges join what was near when it was first seen. Where a fold is pulled over the tissue behind
// it, they join what does not belong together, and their strain grows without end. With these
// weights, which are those of the loss e^2 / (1 + (e / s)^2) of Geman and McClure, they give way;
// they are as stiff as before when the strain is gone.
void UpdateEdgeWeights(const std::vector<int>& nodes, double yield_strain, DeformableMap* map);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_EDGE_WEIGHTS_H_
