// Renders a triangle mesh: depth, colour, and the noise of a depth camera.
#ifndef CERES_ED_SIMULATION_RENDERING_H_
#define CERES_ED_SIMULATION_RENDERING_H_

#include <ceres_ed/geometry/depth_noise.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/simulation/texture.h>

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The place on a mesh that a pixel sees.
struct SyntheticFragment {
  // The triangle, or -1 if the pixel sees nothing.
  int triangle = -1;
  // The barycentric weights of the triangle's corners at that place; they sum to 1.
  std::array<float, 3> weights = {0.0F, 0.0F, 0.0F};
};

// What a camera sees of a mesh, pixel by pixel.
struct SyntheticRaster {
  DepthImage depth;
  Image<SyntheticFragment> fragments;

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
SyntheticRaster RasterizeMesh(const std::vector<Eigen::Vector3d>& points,
                              const std::vector<std::array<int, 3>>& triangles,
                              const PinholeCamera& camera);

// Returns one unit normal per point, the mean of its triangles' normals weighted by area; zero for
// a point without triangles.
std::vector<Eigen::Vector3d> AreaWeightedNormals(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<std::array<int, 3>>& triangles);

// Returns, for each pixel, the cosine in [0, 1] of the angle between its ray and the normal of the
// surface that it sees, and 0 where it sees nothing. `normals` has one normal per vertex, in the
// camera frame.
Image<float> IncidenceCosines(const SyntheticRaster& raster,
                              const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Eigen::Vector3d>& normals,
                              const PinholeCamera& camera);

// Returns the picture under a lamp at the camera; it is black where nothing is seen. `rest` is the
// position of each vertex when the tissue is at rest, in metres. `cosines` is the result of
// IncidenceCosines().
ColorImage ShadeTissue(const SyntheticRaster& raster,
                       const std::vector<std::array<int, 3>>& triangles,
                       const std::vector<Eigen::Vector3d>& rest,
                       const Image<float>& cosines,
                       const PinholeCamera& camera,
                       const SyntheticTexture& texture);

// What one camera sees: geometry and colour.
struct RenderedView {
  SyntheticRaster raster;
  // See IncidenceCosines().
  Image<float> cosines;
  // The unit normals of the mesh's vertices in the camera frame.
  std::vector<Eigen::Vector3d> normals;
  // Empty if no colour was requested.
  ColorImage color;
};

// Adds the mirror image of a small lamp on wet tissue (Blinn and Phong) to `view.color`: white
// where the normal halves the angle between the directions to the camera and to `lamp`, a point in
// the camera frame in metres.
void AddHighlights(const std::vector<std::array<int, 3>>& triangles,
                   const PinholeCamera& camera,
                   const Eigen::Vector3d& lamp,
                   RenderedView* view);

// Adds Gaussian noise of the standard deviation `sigma` >= 0, in levels, to the brightness of each
// pixel. The same seed gives the same noise.
void AddPictureNoise(double sigma, std::uint64_t seed, ColorImage* color);

// Adds the errors of a depth camera to the pixels of `depth` that are not 0. The standard deviation
// is that of `noise` (metres) for a surface seen straight on. It grows as 1 / cosine, up to ten
// times. Half of the variance is independent for each pixel, and half is shared with the pixels up
// to four pixels away (the correlation between neighbours in a row is 0.4). Below a cosine of 0.35
// a growing share of the pixels drops out, and at 0.1 all do. A noise of 0 changes nothing. The
// same seed gives the same errors.
void AddDepthNoise(const DepthNoise& noise,
                   std::uint64_t seed,
                   const Image<float>& cosines,
                   DepthImage* depth);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_RENDERING_H_
