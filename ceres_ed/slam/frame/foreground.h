// Finds what moves on its own before the tissue: tools and hands.
#ifndef CERES_ED_SLAM_FRAME_FOREGROUND_H_
#define CERES_ED_SLAM_FRAME_FOREGROUND_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// The foreground of a sequence. A part of the observed surface belongs to it if
//   - it lies before the map, or it did in the frame before; in the first frame, where there is no
//     map, if it is a smaller part that comes in from the border of the picture;
//   - the depth jumps at its border, as it does around a tool, but not around tissue that rises;
//   - it does not stand still: what has stayed in its place for a while is a part of the scene.
class Foreground {
 public:
  explicit Foreground(const PinholeCamera& camera) : camera_(camera) {}

  // Removes the patches of the foreground from `surface`. `visible` are the points of the map that
  // the camera sees; none in the first frame. Returns the share of the patches that were removed.
  double Remove(const std::vector<VisiblePoint>& visible,
                const CameraPose& camera_from_map,
                ObservedSurface* surface);

  // Returns the pixels of the foreground of the last frame, which are 1; all others are 0. It is
  // empty before the first frame.
  MaskImage Mask() const;

  // Saves what the next frame needs, or loads it.
  void Exchange(CheckpointArchive* archive);

 private:
  // What is kept of a cell of the foreground.
  struct Cell {
    // Its index among the cells of the surface, row by row.
    int at = 0;
    // The place in the map frame where its surface was when its age was 0.
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    // The place in this frame.
    Eigen::Vector3d now = Eigen::Vector3d::Zero();
    // The number of frames in which its surface stood still; -1 if it is not foreground.
    int age = -1;
    bool in_foreground() const { return age >= 0; }
  };

  Cell Continue(const CameraPose& camera_from_map, const SurfacePatch& patch) const;
  // Sets the cells of a surface of this size; all others are not foreground.
  void SetCells(int width, int height, std::vector<Cell> cells);

  PinholeCamera camera_;
  int cell_ = 1;
  CameraPose camera_from_map_;
  // The cells of the last frame that are foreground, and for each cell of the surface its index
  // among them, or kNoCell. Most frames have few or none of them.
  static constexpr int kNoCell = -1;
  std::vector<Cell> cells_;
  Image<int> cell_at_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_FOREGROUND_H_
