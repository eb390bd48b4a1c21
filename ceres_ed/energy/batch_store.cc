#include "ceres_ed/energy/batch_store.h"

#include <array>
#include <cmath>
#include <utility>

#include <cost_functions/node_parameters.h>
#include <cost_functions/warp.h>

namespace ceres_ed {
namespace {

// Returns the unit normal of the warped surface: the cofactor matrix of sum_i w_i A_i times the
// normal at rest (see WarpNormal() in graph/warp.h, which also treats gradients of rank 1; here the
// normal is zero then).
Eigen::Vector3d WarpedNormal(const BoundPoint& point,
                             const double* const* nodes,
                             const Eigen::Vector3d& normal) {
  Eigen::Matrix3d G = Eigen::Matrix3d::Zero();
  for (int i = 0; i < point.num_nodes(); ++i) G += point.weight(i) * NodeAffine(nodes[i]);
  const Eigen::Vector3d warped = normal.x() * G.col(1).cross(G.col(2)) +
                                 normal.y() * G.col(2).cross(G.col(0)) +
                                 normal.z() * G.col(0).cross(G.col(1));
  const double length = warped.norm();
  return length > 0.0 ? Eigen::Vector3d(warped / length) : Eigen::Vector3d::Zero();
}

// A residual of a batch function as a cost function, for solvers that take one residual at a time.
// Parameter blocks: the point's nodes (12 each), then, with a camera, R_c (4) and T_c (3).
class BatchPointCost final : public ceres::CostFunction {
 public:
  BatchPointCost(std::shared_ptr<const PointBatchFunction> function,
                 int num_residuals,
                 const StoredPoint& stored,
                 const BoundPoint& point,
                 Eigen::Vector3d normal)
      : function_(std::move(function)),
        index_(stored.index),
        has_camera_(stored.has_camera),
        point_(point),
        normal_(std::move(normal)) {
    set_num_residuals(num_residuals);
    mutable_parameter_block_sizes()->assign(point.num_nodes(), kNodeSize);
    if (!has_camera_) return;
    mutable_parameter_block_sizes()->push_back(kRotationSize);
    mutable_parameter_block_sizes()->push_back(kTranslationSize);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const int num_nodes = point_.num_nodes();
    const Eigen::Vector3d in_map = WarpToMap(point_, parameters);
    Eigen::Vector3d warped = in_map;
    Eigen::Vector3d normal = WarpedNormal(point_, parameters, normal_);
    Eigen::Quaterniond R_c = Eigen::Quaterniond::Identity();
    if (has_camera_) {
      R_c = Eigen::Map<const Eigen::Quaterniond>(parameters[num_nodes]);
      warped = MapToCamera(parameters[num_nodes], parameters[num_nodes + 1], in_map);
      normal = R_c * normal;
    }
    Jacobian by_warped(num_residuals(), 3);
    const PointBatch batch = {1, &index_, warped.data(), normal.data()};
    if (!function_->Evaluate(batch, num_residuals(), residuals, by_warped.data())) return false;
    if (jacobians == nullptr) return true;
    const Jacobian by_map = by_warped * R_c.toRotationMatrix();
    for (int i = 0; i < num_nodes; ++i) {
      if (jacobians[i] == nullptr) continue;
      Eigen::Map<Jacobian> J(jacobians[i], num_residuals(), kNodeSize);
      for (int c = 0; c < 3; ++c) {
        J.middleCols<3>(3 * c) = point_.weight(i) * point_.offset(i)[c] * by_map;
      }
      J.middleCols<3>(kNodeTranslationOffset) = point_.weight(i) * by_map;
    }
    if (has_camera_ && jacobians[num_nodes] != nullptr) {
      Eigen::Map<Jacobian>(jacobians[num_nodes], num_residuals(), kRotationSize) =
          by_warped * RotatedByQuaternion(R_c, in_map);
    }
    if (has_camera_ && jacobians[num_nodes + 1] != nullptr) {
      Eigen::Map<Jacobian>(jacobians[num_nodes + 1], num_residuals(), kTranslationSize) = by_warped;
    }
    return true;
  }

 private:
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::shared_ptr<const PointBatchFunction> function_;
  int index_;
  bool has_camera_;
  BoundPoint point_;
  Eigen::Vector3d normal_;
};

}  // namespace

void BatchPointStore::SetFunction(std::shared_ptr<const PointBatchFunction> function,
                                  int num_residuals) {
  function_ = std::move(function);
  SetNumResiduals(num_residuals);
}

void BatchPointStore::Add(const Eigen::Vector3d& position,
                          const Eigen::Vector3d& normal,
                          int index,
                          const Binding& binding,
                          bool has_camera) {
  AddPoint(position, index, binding, has_camera);
  normals_.push_back(normal);
}

void BatchPointStore::Clear() {
  PointStore::Clear();
  normals_.clear();
}

bool BatchPointStore::EvaluateAll(int count,
                                  const int* indices,
                                  const BlockRef* const* blocks,
                                  const DeformationGraph& graph,
                                  const DeformationState& state,
                                  double* residuals,
                                  double* jacobians) const {
  std::vector<int> point_indices(count);
  std::vector<Eigen::Vector3d> points(count), normals(count);
  std::array<const double*, kMaxBoundNodes> nodes{};
  for (int k = 0; k < count; ++k) {
    const StoredPoint& stored = point(indices[k]);
    for (int i = 0; i < stored.num_nodes; ++i) nodes[i] = state.node(blocks[k][i].node);
    const BoundPoint bound = Bind(indices[k], blocks[k], graph);
    point_indices[k] = stored.index;
    points[k] = WarpToMap(bound, nodes.data());
    normals[k] = WarpedNormal(bound, nodes.data(), normals_[indices[k]]);
    if (!stored.has_camera) continue;
    points[k] = state.camera_from_map * points[k];
    normals[k] = state.camera_from_map.rotation * normals[k];
  }
  if (count == 0) return true;
  return function_->Evaluate(
      {count, point_indices.data(), points.front().data(), normals.front().data()},
      num_residuals(),
      residuals,
      jacobians);
}

bool BatchPointStore::EvaluateAtPoints(int count,
                                       const int* indices,
                                       const double* warped,
                                       double* residuals,
                                       double* jacobians) const {
  std::vector<int> point_indices;
  std::vector<Eigen::Vector3d> normals;
  for (int k = 0; k < count; ++k) {
    point_indices.push_back(point(indices[k]).index);
    normals.push_back(normals_[indices[k]]);
  }
  if (count == 0) return true;
  std::vector<double> unused(jacobians == nullptr ? std::size_t{3} * count * num_residuals() : 0);
  return function_->Evaluate({count, point_indices.data(), warped, normals.front().data()},
                             num_residuals(),
                             residuals,
                             jacobians != nullptr ? jacobians : unused.data());
}

bool BatchPointStore::Evaluate(int index,
                               const BlockRef* blocks,
                               const DeformationGraph& graph,
                               const DeformationState& state,
                               double* residuals) const {
  std::vector<double> jacobian(std::size_t{3} * num_residuals());
  return EvaluateAll(1, &index, &blocks, graph, state, residuals, jacobian.data());
}

std::unique_ptr<ceres::CostFunction> BatchPointStore::MakeCost(
    int index, const BlockRef* blocks, const DeformationGraph& graph) const {
  return std::make_unique<BatchPointCost>(
      function_, num_residuals(), point(index), Bind(index, blocks, graph), normals_[index]);
}

}  // namespace ceres_ed
