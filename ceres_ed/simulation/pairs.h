// Pairs of surfaces with ground truth, which are the sample data and material for tests.
#ifndef CERES_ED_SIMULATION_PAIRS_H_
#define CERES_ED_SIMULATION_PAIRS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/simulation/shapes.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A source, the target to fit it to, and the true place of each source vertex.
struct SyntheticPair {
  std::string name;
  SyntheticShape shape = SyntheticShape::kPlane;
  // The size in metres, as in MakeSyntheticShape().
  double size = 0.0;
  std::uint64_t seed = 0;
  // The standard deviation of the noise on each target coordinate, in metres.
  double noise = 0.0;
  // The rigid motion that follows the deformation.
  Similarity target_from_source;

  PointCloud source;
  // The target has a mesh of its own: its vertices are not vertices of the truth.
  PointCloud target;
  // Every source vertex in the frame of the target, in the order of the source and with its
  // triangles.
  PointCloud truth;
  // The share of the area of the true surface that the target covers; 1 for a full target.
  double overlap = 1.0;
  // The source vertices whose true place the camera sees; empty for a full target.
  std::vector<int> visible;
  // The source vertices of the handles with their true places; only for the dolphin.
  std::vector<std::pair<int, Eigen::Vector3d>> landmarks;
  // The source vertices that the deformation does not move; only for the dolphin.
  std::vector<int> fixed;
};

// Returns the names of the pairs, in order: plane_bumps, dolphin_bend, heart_partial,
// kidney_partial, stomach_partial.
std::vector<std::string> SyntheticPairNames();

// Returns the pair with that name, which is the same one each time. It CHECK-fails on an unknown
// name.
SyntheticPair MakeSyntheticPair(const std::string& name);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_PAIRS_H_
