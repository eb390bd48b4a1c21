// Landmarks that are named on both surfaces of a fit.
#ifndef CERES_ED_PIPELINE_FIT_NAMED_LANDMARKS_H_
#define CERES_ED_PIPELINE_FIT_NAMED_LANDMARKS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A landmark on both surfaces, each in the frame and unit of its mesh.
struct LandmarkPair {
  std::string name;
  Eigen::Vector3d source = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

struct NamedLandmarks {
  // In the order of the source's file.
  std::vector<LandmarkPair> pairs;
  // The names of those without a partner.
  std::vector<std::string> only_source;
  std::vector<std::string> only_target;
  // About the files, about landmarks without a partner, and about landmarks that are far from their
  // surface.
  std::vector<std::string> warnings;
};

// A surface on which landmarks lie.
struct LandmarkSurface {
  // Without points if there is no such surface.
  const PointCloud& cloud;
  const PlyDocument& document;
};

// Returns the space of a mesh: the setting, or what its document says (io/mesh/mesh_space.h), or
// LPS.
AnatomicalSpace SpaceOfMesh(MeshSpace setting, const PlyDocument& document);

// The landmarks of one surface.
struct SurfaceLandmarks {
  // The names of the mesh and of its landmarks in messages.
  std::string mesh;
  std::string name;
  const LandmarkSurface& surface;
  LandmarkFile file;
};

// Matches landmarks by name. Positions in RAS or LPS are turned into the SpaceOfMesh() of their
// mesh. It is an error if no name is on both surfaces.
StatusOr<NamedLandmarks> MatchLandmarks(MeshSpace setting,
                                        const SurfaceLandmarks& source,
                                        const SurfaceLandmarks& target);

// Reads settings.source_landmarks and settings.target_landmarks, and matches them.
StatusOr<NamedLandmarks> LoadNamedLandmarks(const FitSettings& settings,
                                            const LandmarkSurface& source,
                                            const LandmarkSurface& target);

// Returns the constraints of `pairs`. A landmark need not be a vertex: the corners of the nearest
// triangle, or the nearest point of a cloud without triangles, take its part. Each is drawn to the
// landmark's target plus its own offset from the landmark, turned and scaled by the similarity that
// fits the pairs best. Fewer than three pairs, or pairs on a line, determine no rotation: then the
// nearest vertex itself is drawn to the target. A vertex serves the first of its landmarks.
std::vector<Landmark> LandmarkConstraints(const std::vector<LandmarkPair>& pairs,
                                          const PointCloud& source);

// The distance of a source landmark from its target, in the target's unit.
struct LandmarkError {
  // As the files lie, but for a given scale.
  double before = 0.0;
  // After the rigid placement of the fit.
  double rigid = 0.0;
  // After the fit: where the surface carries the landmark (carried_points.h).
  double after = 0.0;
};

// Returns the error of each pair. `scale` is by what the source was multiplied before anything
// else, and `fitted` are the points of `source` after the fit.
std::vector<LandmarkError> MeasureLandmarkPairs(const std::vector<LandmarkPair>& pairs,
                                                const PointCloud& source,
                                                const std::vector<Eigen::Vector3d>& fitted,
                                                const Similarity& rigid,
                                                double scale);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_NAMED_LANDMARKS_H_
