// What nodes did while they were seen: where they are thought to be while nobody looks.
#ifndef CERES_ED_SLAM_MAP_TISSUE_MEMORY_H_
#define CERES_ED_SLAM_MAP_TISSUE_MEMORY_H_

#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/map/node_prior_source.h>
#include <ceres_ed/slam/slam_options.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// Breathing and heartbeat bring tissue back to where it was. The places of observed nodes are kept
// moment by moment; hidden ones are recalled as they were when what is in view looked as it does
// now, up to a common rigid motion, which is the gauge of map and camera.
//
// Within a frame: BeginFrame(), then Look() ahead of every solve, priors as they are asked for, and
// Keep() at the end. The cost is that of the view and of the runs of nodes of all
// moments, and the memory six bytes a node of each moment, whatever else the map has.
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
  // recalled as ever.
  std::vector<int> Affected() const;

  // Keeps t_j of the nodes that are `observed`.
  void Keep(const NodeSet& observed, const DeformableMap& map);

  std::size_t HeapBytes() const;

  // For checkpoints, between frames.
  void Exchange(CheckpointArchive* archive);

 private:
  // Nodes first, first + 1, ...
  struct Run {
    int first = 0;
    int count = 0;
  };
  // t_j of the nodes that were seen, by number. A component is one of 65536 steps of the box that
  // they span, some 1e-4 of a spacing, where moments are alike up to `likeness`.
  struct Moment {
    std::vector<Run> runs;
    std::vector<std::array<std::uint16_t, 3>> translations;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();

    Eigen::Vector3d Translation(std::size_t row) const;
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
  static Moment MakeMoment(const std::vector<int>& nodes, const DeformableMap& map);
  // Calls visit(k, t) for each nodes[k], by number, that the moment knows.
  template <typename Visit>
  static void VisitCommon(const Moment& moment, const std::vector<int>& nodes, Visit visit);
  void Thin();

  TissueMemoryOptions options_;
  // Number of the next moment.
  int next_moment_ = 0;
  // Only moments whose number it divides are kept.
  int stride_ = 1;
  // By number / stride.
  std::vector<Moment> moments_;

  // Of the present frame: nodes whose prior is settled, and the moments by moment / stride.
  NodeSet anchored_;
  std::vector<Alignment> alignments_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_TISSUE_MEMORY_H_
