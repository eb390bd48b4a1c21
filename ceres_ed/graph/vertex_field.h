// Displacements between and around the points of a field.
#ifndef CERES_ED_GRAPH_VERTEX_FIELD_H_
#define CERES_ED_GRAPH_VERTEX_FIELD_H_

#include <ceres_ed/graph/warp.h>

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

// Turns each normal by the smallest rotation that takes the unit normal `before` to the unit normal
// `after`. A normal is not changed where one of these is zero.
void TurnNormals(const std::vector<Eigen::Vector3d>& before,
                 const std::vector<Eigen::Vector3d>& after,
                 std::vector<Eigen::Vector3d>* normals);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_VERTEX_FIELD_H_
