// Applies a warp to points that lie on the surface that was fitted: annotations and landmarks.
#ifndef CERES_ED_PIPELINE_APPLY_WARPED_POINTS_H_
#define CERES_ED_PIPELINE_APPLY_WARPED_POINTS_H_

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Reads the surface that was fitted, as ed_fit does.
StatusOr<LoadedCloud> LoadFittedSurface(const std::string& path);

// Returns `points` after the warp. With the `surface` that was fitted, each point is attached to
// its nearest triangle, as ed_fit measures landmarks. If it is null, a point follows the nearest
// nodes, which may belong to another sheet of a thin surface. Errors begin with `warp_path`.
StatusOr<std::vector<Eigen::Vector3d>> WarpedPoints(const Warp& warp,
                                                    const std::string& warp_path,
                                                    const LoadedCloud* surface,
                                                    const std::vector<Eigen::Vector3d>& points);

// Returns the positions of the landmarks after the warp, in the space of their file. The warp is in
// the space of its meshes: `mesh_space`, or what the file of `surface` says, or LPS.
StatusOr<std::vector<Eigen::Vector3d>> WarpedLandmarks(const Warp& warp,
                                                       const std::string& warp_path,
                                                       const LoadedCloud* surface,
                                                       MeshSpace mesh_space,
                                                       const LandmarkFile& landmarks);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_APPLY_WARPED_POINTS_H_
