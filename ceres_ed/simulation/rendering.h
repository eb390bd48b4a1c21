// Pictures of a triangle mesh: depth, colour, and the noise of a depth camera.
#ifndef CERES_ED_SIMULATION_RENDERING_H_
#define CERES_ED_SIMULATION_RENDERING_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/simulation/texture.h>

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The place of a mesh that a pixel sees.
struct SyntheticFragment {
  // -1: none.
  int triangle = -1;
  // Weights of the triangle's corners there; they sum to 1.
  std::array<float, 3> weights = {0.0F, 0.0F, 0.0F};
};

// A mesh as a camera sees it, pixel by pixel.
struct SyntheticRaster {
  DepthImage depth;
  Image<SyntheticFragment> fragments;

  // Returns the value at the place that pixel (u, v) sees of a field with one vector a vertex; the
  // pixel must see the mesh that was drawn.
  Eigen::Vector3d Interpolate(const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Eigen::Vector3d>& field,
                              int u,
                              int v) const;
};

// Returns what each pixel's centre sees first of the triangles, from either side. `points`: camera
// frame, metres. A triangle that reaches nearer than 0.1 mm to the camera's plane is left out.
SyntheticRaster RasterizeMesh(const std::vector<Eigen::Vector3d>& points,
                              const std::vector<std::array<int, 3>>& triangles,
                              const PinholeCamera& camera);

// Returns one unit normal a point, its triangles weighted by their area; zero without any.
std::vector<Eigen::Vector3d> AreaWeightedNormals(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<std::array<int, 3>>& triangles);

// Returns for each pixel the cosine in [0, 1] between its ray and the normal of what it sees; 0
// where it sees nothing. `normals`: one a vertex, camera frame.
Image<float> IncidenceCosines(const SyntheticRaster& raster,
                              const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Eigen::Vector3d>& normals,
                              const PinholeCamera& camera);

// Returns the picture under a lamp at the camera; black where nothing is seen. `rest`: where each
// vertex is when the tissue is at rest, metres. `cosines`: as of IncidenceCosines.
ColorImage ShadeTissue(const SyntheticRaster& raster,
                       const std::vector<std::array<int, 3>>& triangles,
                       const std::vector<Eigen::Vector3d>& rest,
                       const Image<float>& cosines,
                       const PinholeCamera& camera,
                       const SyntheticTexture& texture);

// Adds a depth camera's errors to the pixels of `depth` that are not 0. The deviation is `sigma` >=
// 0 (metres) seen straight on and grows as 1 / cosine, to ten times at most; half of the variance
// is each pixel's own, half is shared with the pixels within four of it (correlation 0.4 between
// neighbours in a row). From a cosine of 0.35 down ever more pixels drop out, at 0.1 all. A sigma
// of 0 changes nothing. The same seed gives the same errors.
void AddDepthNoise(double sigma,
                   std::uint64_t seed,
                   const Image<float>& cosines,
                   DepthImage* depth);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_RENDERING_H_
