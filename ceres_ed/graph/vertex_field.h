// Displacements between and around the points of a field.
#ifndef CERES_ED_GRAPH_VERTEX_FIELD_H_
#define CERES_ED_GRAPH_VERTEX_FIELD_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/graph/warp.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the displacement at each of `queries`. At a point of the field it is exactly that of the
// point. Elsewhere it is the mean over the 4 nearest field points, weighted by 1 / d^2, so it is
// never longer than the longest of theirs. It fades out with the distance: let h be the mean
// distance of the nearest field point from its own 4 nearest neighbours. Up to 2 h from that point
// the displacement is used in full, and at 6 h it has faded to zero. If the queries are the points
// of the field in the same order, no search is needed. A field without points is zero everywhere.
std::vector<Eigen::Vector3d> EvaluateField(const VertexField& field,
                                           const std::vector<Eigen::Vector3d>& queries,
                                           int num_threads = 1);

// Evaluates a field at single points, with the values of EvaluateField(). Any number of threads may
// use it at the same time.
class VertexFieldSampler {
 public:
  // Copies what it needs of `field`. If more than so many queries are expected as the field has
  // points, it computes the spacing around each point ahead, on `num_threads` threads.
  VertexFieldSampler(const VertexField& field, std::size_t expected_queries, int num_threads);
  // It refers to its own members.
  VertexFieldSampler(const VertexFieldSampler&) = delete;
  VertexFieldSampler& operator=(const VertexFieldSampler&) = delete;

  // Returns the displacement at `query`. Writes its derivative by the query to `gradient` unless
  // that is null: entry (r, c) is that of component r by coordinate c. (At the few places where the
  // nearest points change the field has no derivative; it is then that of one side.)
  Eigen::Vector3d At(const Eigen::Vector3d& query, Eigen::Matrix3d* gradient = nullptr) const;

 private:
  std::vector<Eigen::Vector3d> Pick(const std::vector<Eigen::Vector3d>& values) const;
  double SpacingAround(int index) const;

  // The points of the field with a position of their own.
  const std::vector<int> order_;
  const std::vector<Eigen::Vector3d> points_;
  const std::vector<Eigen::Vector3d> displacements_;
  const KdTree tree_;
  // The mean distance of each point from its nearest neighbours; empty if it is not computed ahead.
  std::vector<double> spacings_;
};

// Turns each normal by the smallest rotation that takes the unit normal `before` to the unit normal
// `after`. A normal is not changed where one of these is zero.
void TurnNormals(const std::vector<Eigen::Vector3d>& before,
                 const std::vector<Eigen::Vector3d>& after,
                 std::vector<Eigen::Vector3d>* normals);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_VERTEX_FIELD_H_
