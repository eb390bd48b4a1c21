#include "ceres_ed/registration/finish/fold_guard.h"

#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <array>
#include <numeric>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr double kMinCosine = 0.2;
// The smallest cosine between a triangle's normal and the normal that the surface should have.
constexpr double kFoldedCosine = 0.2;
constexpr double kMaxAreaRatio = 10.0;
// How often a displacement is smoothed, and then halved, before it is set to zero.
constexpr int kSmoothings = 8;
constexpr int kHalvings = 6;

bool IsBad(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  const double area_before = before.norm();
  const double area_after = after.norm();
  return before.dot(after) < kMinCosine * area_before * area_after ||
         area_after * kMaxAreaRatio < area_before || area_before * kMaxAreaRatio < area_after;
}

// Returns the mean of the displacement of `v` and the mean displacement of its neighbours.
Eigen::Vector3d Smoothed(const WeldedMesh& mesh,
                         const std::vector<Eigen::Vector3d>& displacements,
                         int v) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int count = mesh.around_offsets[v + 1] - mesh.around_offsets[v];
  for (int e = mesh.around_offsets[v]; e < mesh.around_offsets[v + 1]; ++e) {
    for (const int corner : mesh.triangles[mesh.around[e]]) sum += displacements[corner];
  }
  // Each triangle also contains the vertex itself.
  const Eigen::Vector3d mean = (sum - count * displacements[v]) / (2.0 * count);
  return 0.5 * (displacements[v] + mean);
}

// Finds the vertices of triangles that turn over or change too much; each vertex is returned once.
class DistortionFinder {
 public:
  DistortionFinder(const WeldedMesh& mesh,
                   const std::vector<Eigen::Vector3d>& start,
                   const std::vector<Eigen::Vector3d>& normals)
      : mesh_(mesh), normals_(normals), is_hit_(start.size(), 0) {
    before_.reserve(mesh.triangles.size());
    for (const std::array<int, 3>& t : mesh.triangles) {
      const Eigen::Vector3d area = AreaVector(start, t);
      const bool is_folded = area.dot(normals[t[0]] + normals[t[1]] + normals[t[2]]) < 0.0;
      before_.push_back(is_folded ? Eigen::Vector3d::Zero() : area);
    }
  }

  std::vector<int> Find(const std::vector<int>& triangles,
                        const std::vector<Eigen::Vector3d>& points) {
    std::vector<int> hit;
    for (const int t : triangles) {
      const Eigen::Vector3d& before = before_[t];
      const std::array<int, 3>& corners = mesh_.triangles[t];
      if (before.isZero(0.0)) continue;
      const Eigen::Vector3d after = AreaVector(points, corners);
      const Eigen::Vector3d should =
          normals_[corners[0]] + normals_[corners[1]] + normals_[corners[2]];
      // A triangle that was nearly folded must not turn any further.
      const bool is_folded = after.dot(should) < kFoldedCosine * after.norm() * should.norm() &&
                             after.dot(should) * before.norm() < before.dot(should) * after.norm();
      if (!is_folded && !IsBad(before, after)) continue;
      for (const int v : corners) {
        if (is_hit_[v] == 0) hit.push_back(v);
        is_hit_[v] = 1;
      }
    }
    for (const int v : hit) is_hit_[v] = 0;
    return hit;
  }

 private:
  const WeldedMesh& mesh_;
  const std::vector<Eigen::Vector3d>& normals_;
  // The area vectors at the start; zero for triangles that may turn.
  std::vector<Eigen::Vector3d> before_;
  std::vector<char> is_hit_;
};

}  // namespace

int DampFolds(const WeldedMesh& mesh,
              const std::vector<Eigen::Vector3d>& start,
              const std::vector<Eigen::Vector3d>& normals,
              std::vector<Eigen::Vector3d>* points) {
  DistortionFinder finder(mesh, start, normals);
  std::vector<Eigen::Vector3d> displacements(start.size());
  for (std::size_t v = 0; v < start.size(); ++v) displacements[v] = (*points)[v] - start[v];
  std::vector<int> times(start.size(), 0);
  std::vector<int> todo(mesh.triangles.size());
  std::iota(todo.begin(), todo.end(), 0);
  while (!todo.empty()) {
    const std::vector<int> hit = finder.Find(todo, *points);
    todo.clear();
    for (const int v : hit) {
      const int time = ++times[v];
      if (time <= kSmoothings) {
        displacements[v] = Smoothed(mesh, displacements, v);
      } else {
        displacements[v] *= time <= kSmoothings + kHalvings ? 0.5 : 0.0;
      }
      (*points)[v] = start[v] + displacements[v];
      todo.insert(todo.end(),
                  mesh.around.begin() + mesh.around_offsets[v],
                  mesh.around.begin() + mesh.around_offsets[v + 1]);
    }
    std::sort(todo.begin(), todo.end());
    todo.erase(std::unique(todo.begin(), todo.end()), todo.end());
  }
  return static_cast<int>(
      std::count_if(times.begin(), times.end(), [](int time) { return time > 0; }));
}

}  // namespace ceres_ed
