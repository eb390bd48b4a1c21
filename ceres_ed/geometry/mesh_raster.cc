#include "ceres_ed/geometry/mesh_raster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kNearestDepth = 1e-4;

// Neighbouring triangles share an edge exactly, but their weights are rounded differently. Without
// this tolerance, a pixel centre on the edge could belong to neither of them.
constexpr double kEdgeTolerance = 1e-9;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns the first and the last integer in [low, high] that is a pixel of a row or column of
// `size` pixels.
std::pair<int, int> PixelRange(double low, double high, int size) {
  return {static_cast<int>(std::ceil(std::clamp(low, 0.0, static_cast<double>(size)))),
          static_cast<int>(std::floor(std::clamp(high, -1.0, size - 1.0)))};
}

class Rasterizer {
 public:
  explicit Rasterizer(const PinholeCamera& camera)
      : camera_(camera), nearness_(camera.width, camera.height, 0.0) {
    raster_.depth = DepthImage(camera.width, camera.height, 0.0F);
    raster_.fragments = Image<MeshFragment>(camera.width, camera.height);
  }

  void Draw(int triangle, const std::array<Eigen::Vector3d, 3>& corners) {
    std::array<Eigen::Vector2d, 3> pixels;
    for (int k = 0; k < 3; ++k) {
      if (!(corners[k].z() >= kNearestDepth)) return;
      pixels[k] = camera_.Project(corners[k]);
    }
    const double area = Cross(pixels[1] - pixels[0], pixels[2] - pixels[0]);
    if (area == 0.0) return;
    const Eigen::Vector2d low = pixels[0].cwiseMin(pixels[1]).cwiseMin(pixels[2]);
    const Eigen::Vector2d high = pixels[0].cwiseMax(pixels[1]).cwiseMax(pixels[2]);
    const auto [u_begin, u_last] = PixelRange(low.x(), high.x(), camera_.width);
    const auto [v_begin, v_last] = PixelRange(low.y(), high.y(), camera_.height);
    for (int v = v_begin; v <= v_last; ++v) {
      for (int u = u_begin; u <= u_last; ++u) {
        const Eigen::Vector2d p(u, v);
        const double wa = Cross(pixels[1] - p, pixels[2] - p) / area;
        const double wb = Cross(pixels[2] - p, pixels[0] - p) / area;
        const double wc = 1.0 - wa - wb;
        if (std::min({wa, wb, wc}) < -kEdgeTolerance) continue;
        DrawPixel(u, v, triangle, {wa / corners[0].z(), wb / corners[1].z(), wc / corners[2].z()});
      }
    }
  }

  MeshRaster Take() { return std::move(raster_); }

 private:
  // The inverse depth is linear over the picture; `shares` are the contributions of the corners to
  // it.
  void DrawPixel(int u, int v, int triangle, const std::array<double, 3>& shares) {
    const double nearness = shares[0] + shares[1] + shares[2];
    if (nearness <= nearness_(u, v)) return;
    nearness_(u, v) = nearness;
    raster_.depth(u, v) = static_cast<float>(1.0 / nearness);
    MeshFragment& fragment = raster_.fragments(u, v);
    fragment.triangle = triangle;
    for (int k = 0; k < 3; ++k) {
      fragment.weights[k] = static_cast<float>(shares[k] / nearness);
    }
  }

  const PinholeCamera& camera_;
  Image<double> nearness_;
  MeshRaster raster_;
};

}  // namespace

Eigen::Vector3d MeshRaster::Interpolate(const std::vector<std::array<int, 3>>& triangles,
                                        const std::vector<Eigen::Vector3d>& field,
                                        int u,
                                        int v) const {
  const MeshFragment& fragment = fragments(u, v);
  const auto& [a, b, c] = triangles[fragment.triangle];
  return static_cast<double>(fragment.weights[0]) * field[a] +
         static_cast<double>(fragment.weights[1]) * field[b] +
         static_cast<double>(fragment.weights[2]) * field[c];
}

MeshRaster RasterizeMesh(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<std::array<int, 3>>& triangles,
                         const PinholeCamera& camera) {
  std::string error;
  CHECK(camera.IsValid(&error)) << error;
  Rasterizer rasterizer(camera);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    rasterizer.Draw(static_cast<int>(t), {points[a], points[b], points[c]});
  }
  return rasterizer.Take();
}

}  // namespace ceres_ed
