#include "ceres_ed/simulation/remesher.h"

#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

bool Has(const std::array<int, 3>& triangle, int vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

void Erase(std::vector<int>* list, int value) {
  list->erase(std::remove(list->begin(), list->end(), value), list->end());
}

void Replace(std::array<int, 3>* triangle, int from, int to) {
  std::replace(triangle->begin(), triangle->end(), from, to);
}

// Returns the largest cosine of the angles of a triangle; the smaller it is, the better the shape.
double WorstCosine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const auto cosine =
      [](const Eigen::Vector3d& o, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
        return (p - o).normalized().dot((q - o).normalized());
      };
  return std::max({cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)});
}

}  // namespace

SyntheticRemesher::SyntheticRemesher(const PointCloud& mesh,
                                     std::function<Eigen::Vector3d(const Eigen::Vector3d&)> project)
    : project_(std::move(project)),
      points_(mesh.points),
      triangles_(mesh.triangles),
      around_(mesh.size()) {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const int vertex : triangles_[t]) around_[vertex].push_back(static_cast<int>(t));
  }
}

int SyntheticRemesher::num_vertices() const {
  return static_cast<int>(std::count_if(
      around_.begin(), around_.end(), [](const std::vector<int>& list) { return !list.empty(); }));
}

std::vector<SyntheticRemesher::Edge> SyntheticRemesher::Edges() const {
  std::vector<Edge> edges;
  edges.reserve(triangles_.size() * 3 / 2);
  for (const auto& triangle : triangles_) {
    if (triangle[0] < 0) continue;
    // Each edge of a closed oriented mesh occurs once with its smaller index first.
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      if (a < b) edges.emplace_back(a, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<int> SyntheticRemesher::Neighbors(int vertex) const {
  std::vector<int> neighbors;
  for (const int t : around_[vertex]) {
    for (const int other : triangles_[t]) {
      if (other != vertex) neighbors.push_back(other);
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return neighbors;
}

std::array<int, 2> SyntheticRemesher::Sides(int a, int b) const {
  std::array<int, 2> sides = {-1, -1};
  int found = 0;
  for (const int t : around_[a]) {
    if (Has(triangles_[t], b)) {
      CHECK_LT(found, 2) << "edge " << a << "-" << b << " has more than two triangles";
      sides[found++] = t;
    }
  }
  return sides;
}

int SyntheticRemesher::Opposite(int triangle, int a, int b) const {
  const auto& t = triangles_[triangle];
  return t[0] + t[1] + t[2] - a - b;
}

void SyntheticRemesher::Split(double longest) {
  for (const auto& [a, b] : Edges()) {
    if (Length(a, b) <= longest) continue;
    const int middle = static_cast<int>(points_.size());
    points_.push_back(project_(0.5 * (points_[a] + points_[b])));
    around_.emplace_back();
    for (const int side : Sides(a, b)) {
      const int opposite = Opposite(side, a, b);
      const int twin = static_cast<int>(triangles_.size());
      triangles_.push_back(triangles_[side]);
      Replace(&triangles_[side], b, middle);
      Replace(&triangles_[twin], a, middle);
      Erase(&around_[b], side);
      around_[b].push_back(twin);
      around_[opposite].push_back(twin);
      around_[middle].push_back(side);
      around_[middle].push_back(twin);
    }
  }
}

bool SyntheticRemesher::MayCollapse(int keep,
                                    int drop,
                                    const Eigen::Vector3d& to,
                                    double longest) const {
  const std::vector<int> ring = Neighbors(keep);
  const std::vector<int> other = Neighbors(drop);
  std::vector<int> common;
  std::set_intersection(
      ring.begin(), ring.end(), other.begin(), other.end(), std::back_inserter(common));
  // The link condition: with more common neighbours, the collapse would pinch the surface.
  if (common.size() != 2) return false;
  for (const int vertex : common) {
    if (around_[vertex].size() <= 3) return false;
  }
  for (const int moved : {keep, drop}) {
    for (const int t : around_[moved]) {
      const auto& triangle = triangles_[t];
      if (Has(triangle, keep) && Has(triangle, drop)) continue;
      std::array<Eigen::Vector3d, 3> corner;
      for (int k = 0; k < 3; ++k) {
        corner[k] = triangle[k] == moved ? to : points_[triangle[k]];
        if (triangle[k] != moved && (corner[k] - to).norm() > longest) return false;
      }
      const Eigen::Vector3d normal = AreaVector(corner[0], corner[1], corner[2]);
      const Eigen::Vector3d before = AreaVector(points_, triangle);
      if (normal.dot(before) <= 0.5 * normal.norm() * before.norm()) return false;
    }
  }
  return true;
}

void SyntheticRemesher::DoCollapse(int keep, int drop, const Eigen::Vector3d& to) {
  points_[keep] = to;
  for (const int side : Sides(keep, drop)) {
    Erase(&around_[keep], side);
    Erase(&around_[Opposite(side, keep, drop)], side);
    triangles_[side] = {-1, -1, -1};
  }
  for (const int t : around_[drop]) {
    if (triangles_[t][0] < 0) continue;
    Replace(&triangles_[t], drop, keep);
    around_[keep].push_back(t);
  }
  around_[drop].clear();
}

void SyntheticRemesher::Collapse(double shortest, double longest) {
  std::vector<std::tuple<double, int, int>> candidates;
  for (const auto& [a, b] : Edges()) {
    if (Length(a, b) < shortest) candidates.emplace_back(Length(a, b), a, b);
  }
  std::sort(candidates.begin(), candidates.end());
  for (const auto& [length, a, b] : candidates) {
    if (around_[a].empty() || around_[b].empty() || Length(a, b) >= shortest) continue;
    if (Sides(a, b)[1] < 0) continue;
    const Eigen::Vector3d middle = project_(0.5 * (points_[a] + points_[b]));
    if (MayCollapse(a, b, middle, longest)) DoCollapse(a, b, middle);
  }
}

void SyntheticRemesher::Flip(bool delaunay) {
  for (const auto& [edge_a, edge_b] : Edges()) {
    int a = edge_a;
    int b = edge_b;
    const auto sides = Sides(a, b);
    // An earlier flip of this pass may have removed the edge.
    if (sides[1] < 0) continue;
    const int c = Opposite(sides[0], a, b);
    const int d = Opposite(sides[1], a, b);
    if (c == d || Sides(c, d)[0] >= 0) continue;
    if (around_[a].size() <= 3 || around_[b].size() <= 3) continue;
    if (delaunay) {
      const auto& p = points_;
      if (std::max(WorstCosine(p[c], p[d], p[b]), WorstCosine(p[c], p[d], p[a])) >=
          std::max(WorstCosine(p[a], p[b], p[c]), WorstCosine(p[a], p[b], p[d])) - 1e-9) {
        continue;
      }
    } else {
      const auto off = [this](int v, int change) {
        return std::abs(static_cast<int>(around_[v].size()) + change - 6);
      };
      if (off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) >=
          off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0)) {
        continue;
      }
    }
    // Side 0 keeps its orientation if b is replaced by d, and side 1 if a is replaced by c.
    std::array<int, 3> first = triangles_[sides[0]];
    std::array<int, 3> second = triangles_[sides[1]];
    Replace(&first, b, d);
    Replace(&second, a, c);
    const Eigen::Vector3d sum = (AreaVector(points_, triangles_[sides[0]]).normalized() +
                                 AreaVector(points_, triangles_[sides[1]]).normalized())
                                    .normalized();
    const double least = std::min(AreaVector(points_, first).normalized().dot(sum),
                                  AreaVector(points_, second).normalized().dot(sum));
    // A flip across a ridge (the edge of a fin) would cut the ridge off.
    if (least < 0.8 || AreaVector(points_, triangles_[sides[0]]).normalized().dot(sum) < 0.8)
      continue;
    triangles_[sides[0]] = first;
    triangles_[sides[1]] = second;
    Erase(&around_[b], sides[0]);
    Erase(&around_[a], sides[1]);
    around_[d].push_back(sides[0]);
    around_[c].push_back(sides[1]);
  }
}

void SyntheticRemesher::Relax() {
  std::vector<Eigen::Vector3d> moved = points_;
  for (std::size_t v = 0; v < points_.size(); ++v) {
    if (around_[v].empty()) continue;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    double weight = 0.0;
    for (const int t : around_[v]) {
      const auto& triangle = triangles_[t];
      const Eigen::Vector3d area = AreaVector(points_, triangle);
      normal += area;
      // Weights by area move vertices toward sparse places and make the triangle sizes more even.
      centroid +=
          area.norm() / 3.0 * (points_[triangle[0]] + points_[triangle[1]] + points_[triangle[2]]);
      weight += area.norm();
    }
    if (weight <= 0.0 || normal.norm() <= 1e-3 * weight) continue;
    normal.normalize();
    Eigen::Vector3d step = centroid / weight - points_[v];
    step -= normal.dot(step) * normal;
    moved[v] = project_(points_[v] + 0.7 * step);
  }
  points_ = std::move(moved);
}

void SyntheticRemesher::Round(double edge) {
  Split(4.0 / 3.0 * edge);
  Collapse(0.8 * edge, 4.0 / 3.0 * edge);
  Flip(/*delaunay=*/false);
  Relax();
}

void SyntheticRemesher::Polish(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    Flip(/*delaunay=*/true);
    Relax();
  }
  Flip(/*delaunay=*/true);
}

PointCloud SyntheticRemesher::Result() const {
  PointCloud mesh;
  std::vector<int> index(points_.size(), -1);
  for (std::size_t v = 0; v < points_.size(); ++v) {
    if (around_[v].empty()) continue;
    index[v] = static_cast<int>(mesh.size());
    mesh.points.push_back(points_[v]);
  }
  for (const auto& t : triangles_) {
    if (t[0] >= 0) mesh.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
  }
  return mesh;
}

}  // namespace ceres_ed
