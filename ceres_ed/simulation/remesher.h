// Isotropic remeshing by local operations: split, collapse, flip, relax.
#ifndef CERES_ED_SIMULATION_REMESHER_H_
#define CERES_ED_SIMULATION_REMESHER_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Brings a closed manifold mesh to near-equilateral triangles of a wanted edge length, after Botsch
// and Kobbelt, "A remeshing approach to multiresolution modeling", 2004. Each operation keeps the
// mesh closed and manifold. Deterministic.
class SyntheticRemesher {
 public:
  // `project` takes a point near the surface onto it.
  SyntheticRemesher(const PointCloud& mesh,
                    std::function<Eigen::Vector3d(const Eigen::Vector3d&)> project);

  // Splits edges above 4/3 of `edge` (> 0), collapses those below 4/5, evens out valences, relaxes.
  void Round(double edge);

  // Relaxes and flips toward the Delaunay triangulation, `rounds` times; the count stays.
  void Polish(int rounds);

  int num_vertices() const;

  // Returns the mesh without the holes that collapses left in the numbering.
  PointCloud Result() const;

 private:
  using Edge = std::pair<int, int>;
  std::vector<Edge> Edges() const;
  std::vector<int> Neighbors(int vertex) const;
  // The triangles on both sides of an edge; {-1, -1} if there is no such edge.
  std::array<int, 2> Sides(int a, int b) const;
  int Opposite(int triangle, int a, int b) const;
  double Length(int a, int b) const { return (points_[a] - points_[b]).norm(); }

  void Split(double longest);
  void Collapse(double shortest, double longest);
  bool MayCollapse(int keep, int drop, const Eigen::Vector3d& to, double longest) const;
  void DoCollapse(int keep, int drop, const Eigen::Vector3d& to);
  // Flips for valence six, or for the larger smallest angle.
  void Flip(bool delaunay);
  void Relax();

  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> project_;
  std::vector<Eigen::Vector3d> points_;
  // A dead triangle has -1 in front; a dead vertex has no triangles around it.
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::vector<int>> around_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_REMESHER_H_
