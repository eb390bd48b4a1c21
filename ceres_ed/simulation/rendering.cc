#include "ceres_ed/simulation/rendering.h"

#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
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
    raster_.fragments = Image<SyntheticFragment>(camera.width, camera.height);
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

  SyntheticRaster Take() { return std::move(raster_); }

 private:
  // The inverse depth is linear over the picture; `shares` are the contributions of the corners to
  // it.
  void DrawPixel(int u, int v, int triangle, const std::array<double, 3>& shares) {
    const double nearness = shares[0] + shares[1] + shares[2];
    if (nearness <= nearness_(u, v)) return;
    nearness_(u, v) = nearness;
    raster_.depth(u, v) = static_cast<float>(1.0 / nearness);
    SyntheticFragment& fragment = raster_.fragments(u, v);
    fragment.triangle = triangle;
    for (int k = 0; k < 3; ++k) {
      fragment.weights[k] = static_cast<float>(shares[k] / nearness);
    }
  }

  const PinholeCamera& camera_;
  Image<double> nearness_;
  SyntheticRaster raster_;
};

}  // namespace

Eigen::Vector3d SyntheticRaster::Interpolate(const std::vector<std::array<int, 3>>& triangles,
                                             const std::vector<Eigen::Vector3d>& field,
                                             int u,
                                             int v) const {
  const SyntheticFragment& fragment = fragments(u, v);
  const auto& [a, b, c] = triangles[fragment.triangle];
  return static_cast<double>(fragment.weights[0]) * field[a] +
         static_cast<double>(fragment.weights[1]) * field[b] +
         static_cast<double>(fragment.weights[2]) * field[c];
}

SyntheticRaster RasterizeMesh(const std::vector<Eigen::Vector3d>& points,
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

std::vector<Eigen::Vector3d> AreaWeightedNormals(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d normal = AreaVector(points[a], points[b], points[c]);
    for (const int k : {a, b, c}) normals[k] += normal;
  }
  for (Eigen::Vector3d& normal : normals) normal = normal.normalized();
  return normals;
}

Image<float> IncidenceCosines(const SyntheticRaster& raster,
                              const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Eigen::Vector3d>& normals,
                              const PinholeCamera& camera) {
  Image<float> cosines(camera.width, camera.height, 0.0F);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (raster.fragments(u, v).triangle < 0) continue;
      const Eigen::Vector3d normal = raster.Interpolate(triangles, normals, u, v);
      const Eigen::Vector3d ray = camera.BackProject(u, v, 1.0);
      const double product = normal.norm() * ray.norm();
      if (product > 0.0) {
        cosines(u, v) = static_cast<float>(std::min(1.0, std::abs(normal.dot(ray)) / product));
      }
    }
  }
  return cosines;
}

ColorImage ShadeTissue(const SyntheticRaster& raster,
                       const std::vector<std::array<int, 3>>& triangles,
                       const std::vector<Eigen::Vector3d>& rest,
                       const Image<float>& cosines,
                       const PinholeCamera& camera,
                       const SyntheticTexture& texture) {
  constexpr double kAmbient = 0.55;
  ColorImage color(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (raster.fragments(u, v).triangle < 0) continue;
      const double cosine = static_cast<double>(cosines(u, v));
      const double pixel = static_cast<double>(raster.depth(u, v)) / camera.fx;
      const Eigen::Vector3d albedo =
          texture.Color(raster.Interpolate(triangles, rest, u, v), pixel);
      const Eigen::Vector3d light = 255.0 * (kAmbient + (1.0 - kAmbient) * cosine) * albedo;
      for (int channel = 0; channel < 3; ++channel) {
        color(u, v)[channel] = static_cast<std::uint8_t>(std::lround(light[channel]));
      }
    }
  }
  return color;
}

void AddHighlights(const std::vector<std::array<int, 3>>& triangles,
                   const PinholeCamera& camera,
                   const Eigen::Vector3d& lamp,
                   RenderedView* view) {
  // The brightness of the mirrored lamp, and how sharply it falls off.
  constexpr double kStrength = 1.5 * 255.0;
  constexpr double kSharpness = 250.0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (view->raster.fragments(u, v).triangle < 0) continue;
      const Eigen::Vector3d point =
          camera.BackProject(u, v, static_cast<double>(view->raster.depth(u, v)));
      const Eigen::Vector3d normal = view->raster.Interpolate(triangles, view->normals, u, v);
      const Eigen::Vector3d half = (lamp - point).normalized() - point.normalized();
      const double product = normal.norm() * half.norm();
      if (product == 0.0) continue;
      const double cosine = std::abs(normal.dot(half)) / product;
      const double light = kStrength * std::pow(cosine, kSharpness);
      for (std::uint8_t& channel : view->color(u, v)) {
        channel = static_cast<std::uint8_t>(std::lround(std::min(255.0, channel + light)));
      }
    }
  }
}

void AddPictureNoise(double sigma, std::uint64_t seed, ColorImage* color) {
  CHECK_GE(sigma, 0.0);
  if (sigma == 0.0) return;
  Random random(seed);
  for (auto& pixel : color->pixels()) {
    const double error = sigma * random.Gaussian();
    for (std::uint8_t& channel : pixel) {
      channel = static_cast<std::uint8_t>(std::lround(std::clamp(channel + error, 0.0, 255.0)));
    }
  }
}

}  // namespace ceres_ed
