// Small meshes of known geometry for the tests.
#ifndef CERES_ED_TEST_GEOMETRY_MESHES_H_
#define CERES_ED_TEST_GEOMETRY_MESHES_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns a mesh of columns x rows vertices in the plane z = 0, `step` apart. The index of a vertex
// is row * columns + column. The diagonals alternate.
inline PointCloud MakeGridMesh(int columns, int rows, double step = 1.0) {
  PointCloud mesh;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) mesh.points.emplace_back(c * step, r * step, 0.0);
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int p = r * columns + c;
      if ((r + c) % 2 == 0) {
        mesh.triangles.push_back({p, p + 1, p + columns + 1});
        mesh.triangles.push_back({p, p + columns + 1, p + columns});
      } else {
        mesh.triangles.push_back({p, p + 1, p + columns});
        mesh.triangles.push_back({p + 1, p + columns + 1, p + columns});
      }
    }
  }
  return mesh;
}

// Returns the unit sphere: an icosahedron that is subdivided `levels` times, with 10 * 4^levels + 2
// vertices.
inline PointCloud MakeSphereMesh(int levels) {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  PointCloud mesh;
  mesh.points = {{-1, t, 0},
                 {1, t, 0},
                 {-1, -t, 0},
                 {1, -t, 0},
                 {0, -1, t},
                 {0, 1, t},
                 {0, -1, -t},
                 {0, 1, -t},
                 {t, 0, -1},
                 {t, 0, 1},
                 {-t, 0, -1},
                 {-t, 0, 1}};
  for (Eigen::Vector3d& point : mesh.points) point.normalize();
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(mesh.size()));
      if (is_new) mesh.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.push_back({a, ab, ca});
      finer.push_back({b, bc, ab});
      finer.push_back({c, ca, bc});
      finer.push_back({ab, bc, ca});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

// Returns `mesh` followed by `other`, which is moved by `offset`.
inline PointCloud Append(PointCloud mesh, const PointCloud& other, const Eigen::Vector3d& offset) {
  const int first = static_cast<int>(mesh.size());
  for (const Eigen::Vector3d& point : other.points) mesh.points.push_back(point + offset);
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + first, b + first, c + first});
  }
  return mesh;
}

// Returns a mesh in which every triangle has its own corners, as in an STL file. `source` receives
// for each corner the vertex of `mesh` from which it comes.
inline PointCloud Unweld(const PointCloud& mesh, std::vector<int>* source) {
  PointCloud soup;
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    const int first = static_cast<int>(soup.size());
    for (const int corner : triangle) {
      soup.points.push_back(mesh.points[corner]);
      source->push_back(corner);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// Returns points that are uniformly distributed in the cube of half side `half_side` around 0.
inline std::vector<Eigen::Vector3d> RandomPoints(int count, unsigned seed, double half_side = 1.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-half_side, half_side);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& point : points) {
    for (int i = 0; i < 3; ++i) point[i] = uniform(random);
  }
  return points;
}

// Moves every point at random by up to `amount` along each axis, so that no two distances tie.
inline void Jitter(double amount, unsigned seed, PointCloud* cloud) {
  const std::vector<Eigen::Vector3d> moves = RandomPoints(static_cast<int>(cloud->size()), seed);
  for (std::size_t p = 0; p < cloud->size(); ++p) cloud->points[p] += amount * moves[p];
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_GEOMETRY_MESHES_H_
