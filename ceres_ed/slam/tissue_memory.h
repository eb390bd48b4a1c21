// What nodes did while they were seen: where they are thought to be while nobody looks.
#ifndef CERES_ED_SLAM_TISSUE_MEMORY_H_
#define CERES_ED_SLAM_TISSUE_MEMORY_H_

#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/slam/deformable_map.h>
#include <ceres_ed/slam/node_prior_source.h>

#include <deque>
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
//
// Within a frame: BeginFrame(), then Look() ahead of every solve, priors as they are asked for, and
// Keep() at the end. The cost is that of the view and of the moments that share nodes with it.
class TissueMemory final : public NodePriorSource {
 public:
  explicit TissueMemory(const TissueMemoryOptions& options) : options_(options) {}

  // Nodes that are `observed` stay where they are, as far as their prior is concerned.
  void BeginFrame(const NodeSet& observed, DeformableMap* map);

  // Compares the present with the moments, by the nodes that are `observed`. From now on these keep
  // the prior that they have.
  void Look(const NodeSet& observed, const DeformableMap& map);

  // The prior of a node that isn't observed is where it is recalled, by the last Look(): the mean
  // over its moments where nothing was alike, the present place where it was never kept.
  void UpdatePriors(const std::vector<int>& nodes, DeformableMap* map) override;

  // Returns the nodes whose recalled place depends on the last Look(), by number; the others are
  // recalled as ever. Valid until the next call.
  const std::vector<int>& Affected();

  // Keeps t_j of the nodes that are `observed`.
  void Keep(const NodeSet& observed, const DeformableMap& map);

  // For checkpoints, between frames.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Trace {
    int moment;
    Eigen::Vector3d translation;
  };
  // A moment laid on the present: q = rotation p + translation, as well as a rigid motion can, and
  // how much it is like it.
  struct Alignment {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    // Mean of |q - rotation p - translation|^2.
    double difference = 0.0;
    int common = 0;
    double likeness = 0.0;
  };
  struct Comparison;

  static Alignment Align(const Comparison& comparison);
  void JudgeLikeness();
  Eigen::Vector3d Recall(int node, const DeformableMap& map) const;
  void ListNodes();
  void Thin();

  TissueMemoryOptions options_;
  // Moments kept, and the number of the next one.
  int kept_ = 0;
  int next_moment_ = 0;
  // Only moments whose number it divides are kept.
  int stride_ = 1;
  // What each node did, oldest first.
  std::deque<std::vector<Trace>> traces_;
  // The nodes of each moment, by moment / stride.
  std::vector<std::vector<int>> nodes_of_moment_;

  // Of the present frame: nodes whose prior is settled, and the moments by moment / stride.
  NodeSet anchored_;
  NodeSet affected_;
  std::vector<Alignment> alignments_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_TISSUE_MEMORY_H_
