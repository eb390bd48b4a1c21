// Renders a triangle mesh: depth, colour, and the noise of a depth camera.
#ifndef CERES_ED_SIMULATION_RENDERING_H_
#define CERES_ED_SIMULATION_RENDERING_H_

#include <ceres_ed/geometry/depth_noise.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/mesh_raster.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/simulation/texture.h>

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns one unit normal per point, the mean of its triangles' normals weighted by area; zero for
// a point without triangles.
std::vector<Eigen::Vector3d> AreaWeightedNormals(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<std::array<int, 3>>& triangles);

// Returns, for each pixel, the cosine in [0, 1] of the angle between its ray and the normal of the
// surface that it sees, and 0 where it sees nothing. `normals` has one normal per vertex, in the
// camera frame.
Image<float> IncidenceCosines(const MeshRaster& raster,
                              const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Eigen::Vector3d>& normals,
                              const PinholeCamera& camera);

// Returns the picture under a lamp at the camera; it is black where nothing is seen. `rest` is the
// position of each vertex when the tissue is at rest, in metres. `cosines` is the result of
// IncidenceCosines().
ColorImage ShadeTissue(const MeshRaster& raster,
                       const std::vector<std::array<int, 3>>& triangles,
                       const std::vector<Eigen::Vector3d>& rest,
                       const Image<float>& cosines,
                       const PinholeCamera& camera,
                       const SyntheticTexture& texture);

// What one camera sees: geometry and colour.
struct RenderedView {
  MeshRaster raster;
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
