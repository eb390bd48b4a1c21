// Remembers the motion of nodes while they were seen, in order to predict where hidden nodes are.
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

// Breathing and heartbeat return tissue to earlier positions. This class stores the positions of
// observed nodes at many moments. It recalls hidden nodes from the moments at which the visible
// nodes looked as they do now, up to a common rigid motion, which is the gauge of map and camera.
//
// Within a frame, call BeginFrame(), then Look() before every solve, UpdatePriors() whenever priors
// are needed, and Keep() at the end. The time depends on the size of the view and on the number of
// runs of nodes in all moments, and the memory is six bytes per node and moment; neither depends on
// the rest of the map.
class TissueMemory final : public NodePriorSource {
 public:
  explicit TissueMemory(const TissueMemoryOptions& options) : options_(options) {}

  // Starts a frame. The prior of each `observed` node is its present position.
  void BeginFrame(const NodeSet& observed, DeformableMap* map);

  // Compares the present positions of the `observed` nodes with all moments. From now on these
  // nodes keep their present prior.
  void Look(const NodeSet& observed, const DeformableMap& map);

  // Sets the prior of nodes that are not observed to their recalled positions, according to the
  // last Look(): the mean over all moments of the node if no moment is similar, and the present
  // position if the node was never stored.
  void UpdatePriors(const std::vector<int>& nodes, DeformableMap* map) override;

  // Returns, in ascending order, the nodes whose recalled position depends on the last Look(). The
  // recalled positions of the others do not change.
  std::vector<int> Affected() const;

  // Stores t_j of the `observed` nodes as a new moment.
  void Keep(const NodeSet& observed, const DeformableMap& map);

  std::size_t HeapBytes() const;

  // Saves or loads the memory, for checkpoints between frames.
  void Exchange(CheckpointArchive* archive);

 private:
  // The nodes first, first + 1, ..., `count` in all.
  struct Run {
    int first = 0;
    int count = 0;
  };
  // The translations t_j of the nodes that were seen at one moment, in ascending order of the
  // nodes. Each component is one of 65536 steps across the box of these translations. If moments
  // are similar up to `likeness`, a step is about 1e-4 of a node spacing.
  struct Moment {
    std::vector<Run> runs;
    std::vector<std::array<std::uint16_t, 3>> translations;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d step = Eigen::Vector3d::Zero();

    Eigen::Vector3d Translation(std::size_t row) const;
  };
  // The rigid motion that maps a moment best to the present, q = rotation p + translation, and the
  // similarity of the two.
  struct Alignment {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    // The mean of |q - rotation p - translation|^2.
    double difference = 0.0;
    int common = 0;
    double likeness = 0.0;
  };
  struct Comparison;

  static Alignment Align(const Comparison& comparison);
  void JudgeLikeness();
  static Moment MakeMoment(const std::vector<int>& nodes, const DeformableMap& map);
  // Calls visit(k, t) for each nodes[k], in ascending order, that the moment contains.
  template <typename Visit>
  static void VisitCommon(const Moment& moment, const std::vector<int>& nodes, Visit visit);
  void Thin();

  TissueMemoryOptions options_;
  // The number of the next moment.
  int next_moment_ = 0;
  // Only moments whose number is divisible by this are stored.
  int stride_ = 1;
  // The stored moments, by number / stride.
  std::vector<Moment> moments_;

  // Data of the present frame: the nodes whose prior is settled, and the alignments by moment /
  // stride.
  NodeSet anchored_;
  std::vector<Alignment> alignments_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_TISSUE_MEMORY_H_
