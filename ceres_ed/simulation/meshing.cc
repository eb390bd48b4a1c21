#include "ceres_ed/simulation/meshing.h"

#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/simulation/remesher.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Intersects the tetrahedra of a grid with the surface. Each grid edge that crosses the surface
// gives one vertex.
class TetrahedraMarcher {
 public:
  TetrahedraMarcher(const SyntheticSolid& solid, double cell) : cell_(cell) {
    const auto [lower, upper] = solid.Bounds();
    origin_ = lower;
    for (int axis = 0; axis < 3; ++axis) {
      count_[axis] = static_cast<int>(std::ceil((upper[axis] - lower[axis]) / cell)) + 2;
    }
    values_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2]);
    for (int z = 0; z < count_[2]; z += kBlock) {
      for (int y = 0; y < count_[1]; y += kBlock) {
        for (int x = 0; x < count_[0]; x += kBlock) FillBlock(solid, {x, y, z});
      }
    }
  }

  PointCloud Run() {
    // The six tetrahedra around the diagonal 0-7 of a cube. The bits of a corner's number are its
    // x, y and z.
    constexpr int kTetrahedra[6][4] = {
        {0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    for (int z = 0; z + 1 < count_[2]; ++z) {
      for (int y = 0; y + 1 < count_[1]; ++y) {
        for (int x = 0; x + 1 < count_[0]; ++x) {
          std::array<int, 8> corners;
          for (int k = 0; k < 8; ++k)
            corners[k] = Index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
          for (const auto& t : kTetrahedra) {
            Cut({corners[t[0]], corners[t[1]], corners[t[2]], corners[t[3]]});
          }
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  static constexpr int kBlock = 5;

  // Evaluates every grid point of a block only if the block is near the surface.
  void FillBlock(const SyntheticSolid& solid, const std::array<int, 3>& first) {
    const double half = 0.5 * (kBlock - 1);
    const double center = solid.Value(
        origin_ + cell_ * Eigen::Vector3d(first[0] + half, first[1] + half, first[2] + half));
    // Twice the distance to the corner, because the distance is exact to first order only.
    const bool is_far = std::abs(center) > 2.0 * std::sqrt(3.0) * half * cell_;
    for (int z = first[2]; z < std::min(first[2] + kBlock, count_[2]); ++z) {
      for (int y = first[1]; y < std::min(first[1] + kBlock, count_[1]); ++y) {
        for (int x = first[0]; x < std::min(first[0] + kBlock, count_[0]); ++x) {
          values_[Index(x, y, z)] = is_far ? center : solid.Value(Position(x, y, z));
        }
      }
    }
  }

  int Index(int x, int y, int z) const { return (z * count_[1] + y) * count_[0] + x; }
  Eigen::Vector3d Position(int x, int y, int z) const {
    return origin_ + cell_ * Eigen::Vector3d(x, y, z);
  }
  Eigen::Vector3d Position(int index) const {
    return Position(
        index % count_[0], index / count_[0] % count_[1], index / count_[0] / count_[1]);
  }

  int Crossing(int a, int b) {
    if (a > b) std::swap(a, b);
    const std::int64_t key = static_cast<std::int64_t>(a) * static_cast<int>(values_.size()) + b;
    const auto [entry, is_new] = crossings_.emplace(key, static_cast<int>(mesh_.size()));
    if (is_new) {
      // Vertices exactly on a grid point would give triangles without area.
      const double t = std::clamp(values_[a] / (values_[a] - values_[b]), 0.05, 0.95);
      mesh_.points.push_back((1.0 - t) * Position(a) + t * Position(b));
    }
    return entry->second;
  }

  void AddTriangle(int a, int b, int c, const Eigen::Vector3d& outward) {
    const auto& p = mesh_.points;
    if (AreaVector(p[a], p[b], p[c]).dot(outward) < 0.0) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  void Cut(const std::array<int, 4>& corners) {
    std::vector<int> inside;
    std::vector<int> outside;
    for (const int corner : corners) (values_[corner] < 0.0 ? inside : outside).push_back(corner);
    if (inside.empty() || outside.empty()) return;
    const Eigen::Vector3d outward = Position(outside[0]) - Position(inside[0]);
    if (inside.size() == 2) {
      const int a = Crossing(inside[0], outside[0]);
      const int b = Crossing(inside[0], outside[1]);
      const int c = Crossing(inside[1], outside[1]);
      const int d = Crossing(inside[1], outside[0]);
      const Eigen::Vector3d to_outside =
          Position(outside[0]) + Position(outside[1]) - Position(inside[0]) - Position(inside[1]);
      AddTriangle(a, b, c, to_outside);
      AddTriangle(a, c, d, to_outside);
      return;
    }
    const std::vector<int>& single = inside.size() == 1 ? inside : outside;
    const std::vector<int>& rest = inside.size() == 1 ? outside : inside;
    AddTriangle(Crossing(single[0], rest[0]),
                Crossing(single[0], rest[1]),
                Crossing(single[0], rest[2]),
                outward);
  }

  double cell_;
  Eigen::Vector3d origin_;
  std::array<int, 3> count_;
  std::vector<double> values_;
  std::unordered_map<std::int64_t, int> crossings_;
  PointCloud mesh_;
};

}  // namespace

PointCloud MarchTetrahedra(const SyntheticSolid& solid, double cell) {
  CHECK_GT(cell, 0.0);
  return TetrahedraMarcher(solid, cell).Run();
}

PointCloud RemeshUniformly(const PointCloud& mesh, const SyntheticSolid& solid, int vertices) {
  CHECK_GE(vertices, 100);
  // In an equilateral tiling with edge length L, each vertex has an area of sqrt(3) / 2 L^2.
  double edge =
      std::sqrt(SurfaceArea(mesh.points, mesh.triangles) / vertices * 2.0 / std::sqrt(3.0));
  SyntheticRemesher remesher(mesh, [&solid](const Eigen::Vector3d& p) { return solid.Project(p); });
  for (int stage = 0; stage < 4; ++stage) {
    for (int round = 0; round < 4; ++round) remesher.Round(edge);
    edge *= std::sqrt(static_cast<double>(remesher.num_vertices()) / vertices);
  }
  remesher.Polish(10);
  return remesher.Result();
}

}  // namespace ceres_ed
