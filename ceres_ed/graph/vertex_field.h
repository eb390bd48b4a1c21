// Displacements of single points, and what they mean for the points between and around them.
#ifndef CERES_ED_GRAPH_VERTEX_FIELD_H_
#define CERES_ED_GRAPH_VERTEX_FIELD_H_

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// One displacement a point, both in the same frame and unit. Points at the same position have the
// same displacement.
struct VertexField {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> displacements;

  bool empty() const { return points.empty(); }
};

// The displacement at every one of `queries`. At a point of the field it is that point's, to the
// bit; elsewhere the mean over the 4 nearest field points, weighted by 1 / d^2, and so never longer
// than the longest of theirs. With h the mean distance of the nearest field point from its own 4
// neighbours it is whole up to 2 h away from that point and fades to zero at 6 h. Queries that are
// the field's points in their order are not searched for. A field without points is zero.
std::vector<Eigen::Vector3d> EvaluateField(const VertexField& field,
                                           const std::vector<Eigen::Vector3d>& queries,
                                           int num_threads = 1);

// Turns each normal by the smallest rotation that takes the unit normal `before` to that `after`;
// leaves it where one of them is zero.
void TurnNormals(const std::vector<Eigen::Vector3d>& before,
                 const std::vector<Eigen::Vector3d>& after,
                 std::vector<Eigen::Vector3d>* normals);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_VERTEX_FIELD_H_
