// What nodes did while they were seen: where they are thought to be while nobody looks.
#ifndef CERES_ED_SLAM_TISSUE_MEMORY_H_
#define CERES_ED_SLAM_TISSUE_MEMORY_H_

#include <ceres_ed/slam/deformable_map.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

struct TissueMemoryOptions {
  // Moments that are kept, >= 2; when there are more, every second one is forgotten.
  int max_moments = 200;
  // Two moments whose tissue differs by less are alike, map units, > 0.
  double likeness = 0.05;
  // A moment counts in full when this many nodes in view were in view then too, >= 1.
  int min_common = 20;
};

// Breathing and heartbeat bring tissue back to where it was. The places of observed nodes are kept
// moment by moment; hidden ones are recalled as they were when what is in view looked as it does
// now, up to a common rigid motion, which is the gauge of map and camera.
class TissueMemory {
 public:
  explicit TissueMemory(const TissueMemoryOptions& options) : options_(options) {}

  // Keeps t_j of the nodes with a nonzero `observed`, one entry a node of the map.
  void Keep(const DeformableMap& map, const std::vector<char>& observed);

  // Returns t_j where each node is thought to be: as it is now for those `observed`, recalled for
  // the others (the mean over its moments where nothing was alike, the present place where it was
  // never kept).
  std::vector<Eigen::Vector3d> Recall(const DeformableMap& map,
                                      const std::vector<char>& observed) const;

  // For checkpoints.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Trace {
    int moment;
    Eigen::Vector3d translation;
  };
  void Thin();

  TissueMemoryOptions options_;
  // Moments kept, and the number of the next one.
  int kept_ = 0;
  int next_moment_ = 0;
  // Only moments whose number it divides are kept.
  int stride_ = 1;
  // What each node did, oldest first.
  std::vector<std::vector<Trace>> traces_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_TISSUE_MEMORY_H_
