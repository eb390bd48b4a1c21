// Pairs of surfaces with truth: the sample data, and material for tests.
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

// A source, the target to fit it to, and where each source vertex really goes.
struct SyntheticPair {
  std::string name;
  SyntheticShape shape = SyntheticShape::kPlane;
  // Metres, as of MakeSyntheticShape.
  double size = 0.0;
  std::uint64_t seed = 0;
  // Deviation of the noise on each target coordinate, metres.
  double noise = 0.0;
  // The rigid motion after the deformation.
  Similarity target_from_source;

  PointCloud source;
  // Meshed apart from the source: its vertices are no vertices of the truth.
  PointCloud target;
  // Every source vertex in the frame of the target, source order, source triangles.
  PointCloud truth;
  // Share of the true surface's area that the target covers; 1 for a full target.
  double overlap = 1.0;
  // Source vertices whose true place the camera sees; empty for a full target.
  std::vector<int> visible;
  // Source vertices of the handles with their true places; dolphin only.
  std::vector<std::pair<int, Eigen::Vector3d>> landmarks;
  // Source vertices that the deformation leaves where they are; dolphin only.
  std::vector<int> fixed;
};

// Returns the names of the pairs, in order: plane_bumps, dolphin_bend, heart_partial,
// kidney_partial, stomach_partial.
std::vector<std::string> SyntheticPairNames();

// Returns the pair of that name, the same one each time; CHECK-fails on an unknown name.
SyntheticPair MakeSyntheticPair(const std::string& name);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_PAIRS_H_
