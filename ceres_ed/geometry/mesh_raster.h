// Draws a triangle mesh into a depth buffer.
#ifndef CERES_ED_GEOMETRY_MESH_RASTER_H_
#define CERES_ED_GEOMETRY_MESH_RASTER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The place on a mesh that a pixel sees.
struct MeshFragment {
  // The triangle, or -1 if the pixel sees nothing.
  int triangle = -1;
  // The barycentric weights of the triangle's corners at that place; they sum to 1.
  std::array<float, 3> weights = {0.0F, 0.0F, 0.0F};
};

// What a camera sees of a mesh, pixel by pixel.
struct MeshRaster {
  DepthImage depth;
  Image<MeshFragment> fragments;

  // Returns the value of a field (one vector per vertex) at the place that pixel (u, v) sees. The
  // pixel must see the mesh that was drawn.
  Eigen::Vector3d Interpolate(const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Eigen::Vector3d>& field,
                              int u,
                              int v) const;
};

// Returns the nearest surface that the centre of each pixel sees, from either side of a triangle.
// `points` are in the camera frame, in metres. A triangle that comes nearer than 0.1 mm to the
// camera's plane is left out.
MeshRaster RasterizeMesh(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<std::array<int, 3>>& triangles,
                         const PinholeCamera& camera);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_MESH_RASTER_H_
