// Depth sequences of deforming tissue with full truth: material for tests, and what ed_simulate
// writes.
#ifndef CERES_ED_SIMULATION_SEQUENCES_H_
#define CERES_ED_SIMULATION_SEQUENCES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/simulation/scene.h>
#include <ceres_ed/simulation/texture.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/options_fwd.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

enum class SyntheticSceneKind { kStrip, kHeart, kKidney, kStomach, kPlane };

constexpr std::array<NamedValue<SyntheticSceneKind>, 5> NamesOf(SyntheticSceneKind) {
  return {{{"strip", SyntheticSceneKind::kStrip},
           {"heart", SyntheticSceneKind::kHeart},
           {"kidney", SyntheticSceneKind::kKidney},
           {"stomach", SyntheticSceneKind::kStomach},
           {"plane", SyntheticSceneKind::kPlane}}};
}

struct SyntheticSequenceOptions {
  SyntheticSceneKind kind = SyntheticSceneKind::kHeart;
  // Frames, 1 to 1000000; 0: as many as the scene needs (organs 60, plane 10, a strip by its
  // length).
  int frames = 0;
  // Strip only: its length is nodes_hint / 300 times what one picture sees, at least 1; so that a
  // map with 300 nodes in view ends with about nodes_hint. 300 to 1000000; 0: by `frames`, or 1000
  // where these are not given either.
  int nodes_hint = 0;
  // Pixels, 16 to 8192. The horizontal field of view is 59.5 degrees at any size.
  int width = 640;
  int height = 480;
  // Of the texture and the noise.
  std::uint64_t seed = 1;
  // Deviation of the depth seen straight on, metres, >= 0; 0: exact. See AddDepthNoise.
  double noise = 0.25e-3;
  // Frames in which the tissue moves there and back, >= 2. The plane moves there only.
  double period = 25.0;
  // Of the tissue's mesh, pictures and truth alike, 500 to 1000000; 0: 12000. Not for a strip,
  // whose truth has a vertex every 1.5 mm.
  int vertices = 0;
  // Whether truth for every vertex is wanted, and how large it may get: what would be larger is
  // thinned, and left out where it would become too coarse to be of use.
  bool truth = true;
  double max_truth_bytes = 1e9;

  // False, with the value and what was expected in `error`, where a value is out of range or a
  // strip's camera would have to move by more than 30 % of its view a frame.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<SyntheticSequenceOptions>& Rows();
};

// A frame and what made it.
struct SyntheticFrame {
  // Metres, with noise.
  DepthImage depth;
  // Empty unless asked for.
  ColorImage color;
  // Empty where every pixel counts. Depth is 0 outside of it.
  MaskImage mask;
  CameraPose world_from_camera;
};

// A sequence whose frames can be made in any order; the same options give the same bits.
//   heart, kidney, stomach: 0.1 m long, deformed there and back by DeformSyntheticPoint, with a
//     camera about 0.05 m away that moves around the long axis by 1.7 degrees a frame;
//   plane: a sheet of 0.2 m that bumps warp by the last frame, under a camera that stands still.
//     Frame 0 sees all of it at rest; later frames only the half in the middle (by a mask), so that
//     the rest of a map is hidden;
//   strip: a band 0.07 m wide with waves that travel through all of it, and a camera 0.1 m above
//     that moves along it at constant speed. The time for a frame does not grow with the length.
class SyntheticSequence {
 public:
  // CHECK-fails on options that are not valid.
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  int num_frames() const { return scene_->num_frames(); }
  const PinholeCamera& camera() const { return camera_; }
  // Units of stored depth: 0.1 mm, which reaches to 6.5 m.
  double depth_units_per_metre() const { return 10000.0; }

  // The tissue at rest whose vertices are the truth, world frame; empty where truth is not wanted
  // or would be too large, and then truth_note() says so.
  const PointCloud& truth_mesh() const { return truth_mesh_; }
  // One sentence where truth was thinned or left out for its size, else empty.
  const std::string& truth_note() const { return truth_note_; }
  // Returns the place of every vertex of truth_mesh() in a frame, world frame. At frame 0 that is
  // truth_mesh() itself.
  std::vector<Eigen::Vector3d> TruthPoints(int frame) const;

  // Returns frame 0 <= `frame` < num_frames().
  SyntheticFrame Render(int frame, bool with_color = true) const;

 private:
  void MakeTruth();

  SyntheticSequenceOptions options_;
  PinholeCamera camera_;
  std::unique_ptr<SyntheticScene> scene_;
  SyntheticTexture texture_;
  PointCloud truth_mesh_;
  std::string truth_note_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SEQUENCES_H_
