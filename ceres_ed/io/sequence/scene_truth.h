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

// The name of the mesh of frame 0, in the world frame, in metres.
inline constexpr char kTruthMeshName[] = "gt_mesh_000000.ply";
// The name of the file of vertices. It has 32-bit floats, little endian: x y z of every vertex of
// frame 0, then of frame 1, and so on.
inline constexpr char kTruthVerticesName[] = "gt_vertices.f32";

// A mesh that moves, and the camera that observes it.
struct SceneTruth {
  std::vector<std::array<int, 3>> triangles;
  int num_vertices = 0;
  // The vertices in the world frame, in metres: x y z of every vertex of frame 0, then of frame 1,
  // and so on.
  std::vector<float> vertices;
  // point_in_world = world_from_camera * point_in_camera, by frame.
  std::map<int, CameraPose> world_from_camera;

  int num_frames() const;
  // Returns whether both the mesh and the camera of `frame` are known.
  bool Has(int frame) const;
  // Returns the mesh in the camera frame of `frame`. Fails a CHECK unless Has(frame).
  PointCloud InCamera(int frame) const;
};

// Returns whether `folder` has one of the two files.
bool HoldsSceneTruth(const std::string& folder);

// Reads the ground truth in `folder` and adds the given cameras. Errors name the file: it can't be
// read, the mesh has vertices that are not finite or no triangles, or the number of values is not
// frames x vertices x 3 with a frame for every camera.
StatusOr<SceneTruth> ReadSceneTruth(const std::string& folder,
                                    const std::map<int, CameraPose>& world_from_camera);

// Writes the two files frame by frame. They are complete when Close() returns; without Close()
// they are not written.
class SceneTruthWriter {
 public:
  // `triangles` are the triangles of the surface. The error gives the system's reason.
  static StatusOr<std::unique_ptr<SceneTruthWriter>> Create(
      const std::string& folder, std::vector<std::array<int, 3>> triangles);

  // Adds the next frame. Fails a CHECK unless each frame has the same number of points.
  Status Add(const std::vector<Eigen::Vector3d>& points);

  // Completes the files. Call it at most once, after at least one frame.
  Status Close();

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
