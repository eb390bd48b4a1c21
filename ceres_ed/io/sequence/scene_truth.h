// gt_vertices.f32 and gt_mesh_000000.ply: the true surface of a scene in each frame.
#ifndef CERES_ED_IO_SEQUENCE_SCENE_TRUTH_H_
#define CERES_ED_IO_SEQUENCE_SCENE_TRUTH_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The mesh of frame 0, metres, world frame.
inline constexpr char kTruthMeshName[] = "gt_mesh_000000.ply";
// 32-bit floats, little endian: x y z of every vertex of frame 0, then of frame 1, and so on.
inline constexpr char kTruthVerticesName[] = "gt_vertices.f32";

// One mesh that moves, and the camera that looks at it.
struct SceneTruth {
  std::vector<std::array<int, 3>> triangles;
  int num_vertices = 0;
  // World frame, metres: x y z of every vertex of frame 0, then of frame 1, and so on.
  std::vector<float> vertices;
  // point_in_world = world_from_camera * point_in_camera, by frame.
  std::map<int, CameraPose> world_from_camera;

  int num_frames() const;
  // Whether both the mesh and the camera of `frame` are known.
  bool Has(int frame) const;
  // The mesh in the camera frame of `frame`; CHECKs Has(frame).
  PointCloud InCamera(int frame) const;
};

// Returns whether `folder` has one of the two files.
bool HoldsSceneTruth(const std::string& folder);

// Returns the truth in `folder`, with the cameras that are given. Errors name the file: one that
// can't be read, a mesh without finite vertices or triangles, vertices of another size than frames
// x vertices x 3, with a frame for every camera.
StatusOr<SceneTruth> ReadSceneTruth(const std::string& folder,
                                    const std::map<int, CameraPose>& world_from_camera);

// Writes the two files frame by frame; they stand when Finish() returns, and not at all if it is
// never called.
class SceneTruthWriter {
 public:
  // `triangles` are the faces of the surface. Error: the system's reason.
  static StatusOr<std::unique_ptr<SceneTruthWriter>> Create(
      const std::string& folder, std::vector<std::array<int, 3>> triangles);

  // Adds the next frame. CHECKs that each frame has the same number of points.
  Status Add(const std::vector<Eigen::Vector3d>& points);

  // To be called once at most, behind one frame at least.
  Status Finish();

 private:
  SceneTruthWriter() = default;

  std::string folder_;
  // The mesh of frame 0.
  PointCloud first_;
  std::unique_ptr<AtomicFile> vertices_;
  // The bytes of one frame.
  std::vector<float> buffer_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SCENE_TRUTH_H_
