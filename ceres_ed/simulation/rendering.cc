#include "ceres_ed/simulation/rendering.h"

#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {

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

Image<float> IncidenceCosines(const MeshRaster& raster,
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

ColorImage ShadeTissue(const MeshRaster& raster,
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
