#include "ceres_ed/graph/warp.h"

#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/vertex_field.h>
#include <ceres_ed/util/parallel.h>

#include <string>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// If a warped normal is shorter than this fraction of the squared stretch, its direction is lost to
// rounding.
constexpr double kMinRelativeNormal = 1e-12;

// Returns the proper rotation nearest to G. A reflection in G is ignored.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& G) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(G, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign[2] = -1.0;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

Status CheckWarp(const Warp& warp) {
  if (warp.graph.num_nodes() == 0) return Status::Error("the warp has no nodes");
  if (warp.state.num_nodes() != warp.graph.num_nodes()) {
    return Status::Error("the warp has " + std::to_string(warp.graph.num_nodes()) +
                         " nodes, but the state of " + std::to_string(warp.state.num_nodes()));
  }
  if (warp.finish.displacements.size() != warp.finish.points.size()) {
    return Status::Error("the finish has " + std::to_string(warp.finish.points.size()) +
                         " points, but " + std::to_string(warp.finish.displacements.size()) +
                         " displacements");
  }
  return Status::Ok();
}

// Adds the finish to `cloud`, whose points the nodes have moved away from `rest`.
void ApplyFinish(const VertexField& field,
                 const std::vector<Eigen::Vector3d>& rest,
                 int num_threads,
                 PointCloud* cloud) {
  const std::vector<Eigen::Vector3d> displacements = EvaluateField(field, rest, num_threads);
  const bool turn_normals = cloud->HasNormals() && cloud->HasTriangles();
  std::vector<Eigen::Vector3d> before;
  if (turn_normals) before = ComputeVertexNormals(*cloud);
  for (std::size_t p = 0; p < cloud->size(); ++p) cloud->points[p] += displacements[p];
  if (turn_normals) TurnNormals(before, ComputeVertexNormals(*cloud), &cloud->normals);
}

}  // namespace

Eigen::Vector3d WarpPoint(const DeformationGraph& graph,
                          const DeformationState& state,
                          const Binding& binding,
                          const Eigen::Vector3d& point) {
  Eigen::Vector3d warped = Eigen::Vector3d::Zero();
  for (int i = 0; i < binding.size; ++i) {
    const double* node = state.node(binding.nodes[i]);
    const Eigen::Vector3d& g_j = graph.position(binding.nodes[i]);
    warped += binding.weights[i] * (NodeAffine(node) * (point - g_j) + g_j + NodeTranslation(node));
  }
  return warped;
}

Eigen::Matrix3d WarpGradient(const DeformationState& state, const Binding& binding) {
  Eigen::Matrix3d G = Eigen::Matrix3d::Zero();
  for (int i = 0; i < binding.size; ++i) {
    G += binding.weights[i] * NodeAffine(state.node(binding.nodes[i]));
  }
  return G;
}

Eigen::Vector3d WarpNormal(const DeformationState& state,
                           const Binding& binding,
                           const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d G = WarpGradient(state, binding);
  // The columns of the cofactor matrix are cross products of those of G.
  const Eigen::Vector3d warped = normal.x() * G.col(1).cross(G.col(2)) +
                                 normal.y() * G.col(2).cross(G.col(0)) +
                                 normal.z() * G.col(0).cross(G.col(1));
  const double length = warped.norm();
  if (length > kMinRelativeNormal * G.squaredNorm()) return warped / length;
  if (normal.isZero(0.0)) return normal;
  return (NearestRotation(G) * normal).normalized();
}

void WarpPoints(const DeformationGraph& graph,
                const DeformationState& state,
                const Skinning& skinning,
                const std::vector<Eigen::Vector3d>& points,
                int num_threads,
                std::vector<Eigen::Vector3d>* warped) {
  CHECK_EQ(skinning.size(), points.size());
  CHECK_EQ(state.num_nodes(), graph.num_nodes());
  warped->resize(points.size());
  ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      (*warped)[p] = WarpPoint(graph, state, skinning[p], points[p]);
    }
  });
}

void WarpNormals(const DeformationState& state,
                 const Skinning& skinning,
                 const std::vector<Eigen::Vector3d>& normals,
                 int num_threads,
                 std::vector<Eigen::Vector3d>* warped) {
  CHECK_EQ(skinning.size(), normals.size());
  warped->resize(normals.size());
  ParallelFor(num_threads, static_cast<int>(normals.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      (*warped)[p] = WarpNormal(state, skinning[p], normals[p]);
    }
  });
}

Status ApplyWarp(const Warp& warp, PointCloud* cloud, int num_threads) {
  if (Status status = CheckWarp(warp); !status.ok()) return status;
  BindingOptions binding = warp.binding;
  binding.num_threads = num_threads;
  const StatusOr<Skinning> skinning = BindCloudToGraph(*cloud, warp.graph, binding);
  if (!skinning.ok()) return skinning.status();
  return ApplyWarp(warp, *skinning, cloud, num_threads);
}

Status ApplyWarp(const Warp& warp, const Skinning& skinning, PointCloud* cloud, int num_threads) {
  if (Status status = CheckWarp(warp); !status.ok()) return status;
  if (skinning.size() != cloud->size()) {
    return Status::Error("the binding is of " + std::to_string(skinning.size()) +
                         " points, but the cloud has " + std::to_string(cloud->size()));
  }
  const bool has_normals = cloud->HasNormals();
  std::vector<Eigen::Vector3d> rest;
  if (!warp.finish.empty()) rest = cloud->points;
  WarpPoints(warp.graph, warp.state, skinning, cloud->points, num_threads, &cloud->points);
  if (has_normals) {
    WarpNormals(warp.state, skinning, cloud->normals, num_threads, &cloud->normals);
  }
  if (!warp.finish.empty()) ApplyFinish(warp.finish, rest, num_threads, cloud);
  // Move the result into the target frame.
  for (Eigen::Vector3d& point : cloud->points) point = warp.target_from_source * point;
  if (!has_normals) return Status::Ok();
  for (Eigen::Vector3d& normal : cloud->normals) {
    normal = warp.target_from_source.rotation * normal;
  }
  return Status::Ok();
}

}  // namespace ceres_ed
