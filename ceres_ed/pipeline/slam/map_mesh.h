// The map as a surface, for viewers that show points as dots.
#ifndef CERES_ED_PIPELINE_SLAM_MAP_MESH_H_
#define CERES_ED_PIPELINE_SLAM_MAP_MESH_H_

#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns an error if the surface of a map cannot be written to `path`.
Status PrepareMapMesh(const std::string& path);

// Writes the points of the map that are neighbours as triangles, in the map frame and in metres,
// with all that map.ply has of them. Edges are at most four times `point_spacing` long, which is in
// node spacings (GrowthOptions).
// Points without neighbours stay without a triangle. The error names the path: PCL's module is
// missing, or the file cannot be written.
Status WriteMapMesh(const std::string& path, const DeformableSlam& slam, double point_spacing);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_MAP_MESH_H_
