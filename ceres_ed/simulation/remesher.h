// Isotropic remeshing by local operations: split, collapse, flip and relax.
#ifndef CERES_ED_SIMULATION_REMESHER_H_
#define CERES_ED_SIMULATION_REMESHER_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Changes a closed manifold mesh to near-equilateral triangles with a given edge length, after
// Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004. Each operation
// keeps the mesh closed and manifold. The result is deterministic.
class SyntheticRemesher {
 public:
  // `project` returns the point of the surface for a point near it.
  SyntheticRemesher(const PointCloud& mesh,
                    std::function<Eigen::Vector3d(const Eigen::Vector3d&)> project);

  // Does one round: splits edges longer than 4/3 of `edge` (> 0), collapses edges shorter than 4/5
  // of it, makes the valences more even, and relaxes the vertices.
  void Round(double edge);

  // Flips edges toward the Delaunay triangulation and relaxes the vertices, `rounds` times. The
  // number of vertices does not change.
  void Polish(int rounds);

  int num_vertices() const;

  // Returns the mesh, renumbered without the vertices that were collapsed.
  PointCloud Result() const;

 private:
  using Edge = std::pair<int, int>;
  std::vector<Edge> Edges() const;
  std::vector<int> Neighbors(int vertex) const;
  // Returns the triangles on both sides of an edge, or {-1, -1} if there is no such edge.
  std::array<int, 2> Sides(int a, int b) const;
  int Opposite(int triangle, int a, int b) const;
  double Length(int a, int b) const { return (points_[a] - points_[b]).norm(); }

  void Split(double longest);
  void Collapse(double shortest, double longest);
  bool MayCollapse(int keep, int drop, const Eigen::Vector3d& to, double longest) const;
  void DoCollapse(int keep, int drop, const Eigen::Vector3d& to);
  // Flips edges for a valence of six, or (`delaunay`) for a larger smallest angle.
  void Flip(bool delaunay);
  void Relax();

  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> project_;
  std::vector<Eigen::Vector3d> points_;
  // A removed triangle has -1 as its first vertex; a removed vertex has no triangles around it.
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::vector<int>> around_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_REMESHER_H_
