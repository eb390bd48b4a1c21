// The corners of the map, and which of them are followed.
#ifndef CERES_ED_SLAM_FRAME_CORNER_STORE_H_
#define CERES_ED_SLAM_FRAME_CORNER_STORE_H_

#include <ceres_ed/slam/frame/corner_descriptors.h>
#include <ceres_ed/slam/frame/patch_template.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <cstddef>
#include <set>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// A corner that is attached to the tissue.
struct Corner {
  // The pixel in the last picture in which the corner was followed.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // The position on the observed surface, in the camera frame.
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  Eigen::Vector3d at_rest = Eigen::Vector3d::Zero();
  int nodes[kMaxBoundNodes];
  double weights[kMaxBoundNodes];
  // 0 for a free slot.
  int num_nodes = 0;
  // How the position at rest changes with the pixel in the picture of `patch`.
  Eigen::Matrix<double, 3, 2> rest_from_pixel = Eigen::Matrix<double, 3, 2>::Zero();
  PatchTemplate patch;
  CornerDescriptor descriptor = {};
  // How well the motion of the corner agrees with that of its neighbours, in [0, 1].
  double weight = 1.0;
  // The number of times that the corner was searched for in vain since it was last found.
  int misses = 0;
  // The order in which corners were born.
  int birth = 0;

  Binding binding() const { return {nodes, weights, num_nodes}; }
};

// Corners by slot. A slot is used again when its corner is removed.
class CornerStore {
 public:
  Corner& operator[](int slot) { return corners_[slot]; }
  const Corner& operator[](int slot) const { return corners_[slot]; }
  // Returns the number of slots, used or not, and the number of corners.
  int num_slots() const { return static_cast<int>(corners_.size()); }
  int num_corners() const { return static_cast<int>(corners_.size() - free_.size()); }

  // Returns the slots of the followed corners.
  const std::vector<int>& followed() const { return followed_; }
  bool IsFollowed(int slot) const { return is_followed_[slot] != 0; }
  // Follows one more corner, or these alone.
  void Follow(int slot);
  void FollowOnly(std::vector<int> slots);

  // Returns the slots of the corners whose strongest node this is.
  const std::vector<int>& OfNode(int node) const;

  // Adds a corner, which is followed. It gets the next number of birth.
  void Add(const Corner& corner);
  // Removes a corner that is not followed any more.
  void Remove(int slot);

  // Returns the bytes on the heap that grow with the map.
  std::size_t HeapBytes() const;
  // Saves all corners, or loads them and replaces the present ones, of a map with `num_nodes`.
  void Exchange(int num_nodes, CheckpointArchive* archive);

 private:
  // Returns whether all corners are bound to nodes of a map with `num_nodes`.
  bool AreBound(int num_nodes) const;
  // Computes what checkpoints do not store.
  void Index();

  std::vector<Corner> corners_;
  // The slots that are free.
  std::set<int> free_;
  std::vector<int> followed_;
  std::vector<char> is_followed_;
  // For each node, the slots of the corners that are bound most strongly to it.
  std::vector<std::vector<int>> of_node_;
  int births_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CORNER_STORE_H_
