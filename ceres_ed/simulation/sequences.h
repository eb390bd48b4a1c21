// Depth sequences of deforming tissue with full ground truth. They are material for tests, and
// ed_simulate writes them to files.
#ifndef CERES_ED_SIMULATION_SEQUENCES_H_
#define CERES_ED_SIMULATION_SEQUENCES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/simulation/rendering.h>
#include <ceres_ed/simulation/scene.h>
#include <ceres_ed/simulation/texture.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The content of a sequence; see SyntheticSequence.
enum class SyntheticSceneKind { kStrip, kHeart, kKidney, kStomach, kPlane };

constexpr std::array<NamedValue<SyntheticSceneKind>, 5> NamesOf(SyntheticSceneKind) {
  return {{{"strip", SyntheticSceneKind::kStrip},
           {"heart", SyntheticSceneKind::kHeart},
           {"kidney", SyntheticSceneKind::kKidney},
           {"stomach", SyntheticSceneKind::kStomach},
           {"plane", SyntheticSceneKind::kPlane}}};
}

// What to simulate.
struct SyntheticSequenceOptions {
  SyntheticSceneKind kind = SyntheticSceneKind::kHeart;
  // Number of frames, 1 to 1000000. With 0 the scene decides: 60 for organs, 10 for the plane, and
  // a number that depends on its length for a strip.
  int frames = 0;
  // Strip only, 300 to 1000000. The strip is nodes_hint / 300 times as long as the part that one
  // picture sees, at least 1, so that a map with 300 nodes in view ends with about nodes_hint
  // nodes. With 0 the length follows from `frames`, or is that of 1000 nodes if `frames` is 0, too.
  int nodes_hint = 0;
  // Size of the pictures in pixels, 16 to 8192. The horizontal field of view is 59.5 degrees at any
  // size.
  int width = 640;
  int height = 480;
  // Seed of the texture and of the noise.
  std::uint64_t seed = 1;
  // Standard deviation of the depth of a surface seen straight on, in metres, >= 0; with 0 the
  // depth is exact. See AddDepthNoise().
  double noise = 0.25e-3;
  // Standard deviation of the disparity of a stereo camera with this baseline, in pixels, >= 0: its
  // noise, z^2 / (f b) times this, is added to that of `noise`.
  double disparity_noise = 0.0;
  // Whether pictures of two cameras are rendered instead of a noisy depth, and the distance of the
  // cameras in metres, in (0, 1].
  bool stereo = false;
  double baseline = 0.005;
  // Standard deviation of the noise of stereo pictures, in levels of 0 to 255, 0 to 50.
  double picture_noise = 1.5;
  // Number of frames in which the tissue moves there and back, >= 2. The plane only moves there.
  double period = 25.0;
  // Number of vertices of the tissue's mesh, for pictures and truth alike, 500 to 1000000; 0 means
  // 12000. Not for a strip, whose truth has a vertex every 1.5 mm.
  int vertices = 0;
  // Whether the truth of every vertex is wanted, and its largest size in bytes. A truth that would
  // be larger is thinned, and is left out if it would become too coarse to be useful.
  bool truth = true;
  double max_truth_bytes = 1e9;

  // Returns false, with the value and what was expected in `error`, if a value is out of range, or
  // if the camera of a strip would have to move by more than 30 % of its view per frame.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<SyntheticSequenceOptions>& Rows();
};

// A frame, and the camera pose and mask with which it was made.
struct SyntheticFrame {
  // The depth in metres, with noise; with stereo, without.
  DepthImage depth;
  // The colour picture; empty unless it was requested. With stereo, that of the left camera.
  ColorImage color;
  // The picture of the right camera; empty without stereo.
  ColorImage right;
  // The mask of the pixels that count; empty if all do. Outside the mask the depth is 0.
  MaskImage mask;
  CameraPose world_from_camera;
};

// A sequence whose frames can be made in any order. The same options give the same bits.
// - heart, kidney, stomach: an organ 0.1 m long that DeformSyntheticPoint() deforms there and back,
//   with a camera about 0.05 m away that moves around the long axis by 1.7 degrees per frame.
// - plane: a sheet of 0.2 m that bumps have warped by the last frame, under a camera that stands
//   still. Frame 0 sees the whole sheet at rest; later frames see only its middle half (through a
//   mask), so that the rest of a map is hidden.
// - strip: a band 0.07 m wide with waves that travel through all of it, and a camera 0.1 m above it
//   that moves along it at constant speed. The time for a frame does not grow with the length.
class SyntheticSequence {
 public:
  // CHECK-fails if the options are not valid.
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  int num_frames() const { return scene_->num_frames(); }
  // The camera; with stereo, the left one.
  const PinholeCamera& camera() const { return camera_; }
  // The two cameras with stereo, otherwise nothing. They are rectified.
  std::optional<StereoRig> rig() const;
  // Returns the units of stored depth per metre: the unit is 0.1 mm, which reaches to 6.5 m.
  double depth_units_per_metre() const { return 10000.0; }

  // The tissue at rest whose vertices have a truth, in the world frame. It is empty if truth is not
  // wanted or would be too large; in the second case truth_note() says so.
  const PointCloud& truth_mesh() const { return truth_mesh_; }
  // One sentence if the truth was thinned or left out because of its size, else empty.
  const std::string& truth_note() const { return truth_note_; }
  // Returns the position of every vertex of truth_mesh() in a frame, in the world frame. In frame 0
  // these are the points of truth_mesh() itself.
  std::vector<Eigen::Vector3d> TruthPoints(int frame) const;

  // Returns the frame with number 0 <= `frame` < num_frames(). Stereo pictures have a lamp between
  // the cameras, highlights where the tissue mirrors it, and noise; their depth is exact. Without
  // stereo the lamp is at the camera and the depth has noise.
  SyntheticFrame Render(int frame, bool with_color = true) const;

 private:
  void MakeTruth();
  RenderedView RenderView(const PointCloud& patch,
                          const std::vector<Eigen::Vector3d>& deformed,
                          const CameraPose& world_from_camera,
                          bool with_color) const;

  SyntheticSequenceOptions options_;
  PinholeCamera camera_;
  std::unique_ptr<SyntheticScene> scene_;
  SyntheticTexture texture_;
  PointCloud truth_mesh_;
  std::string truth_note_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SEQUENCES_H_
