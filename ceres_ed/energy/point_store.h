// Residuals on warped points, stored in arrays.
#ifndef CERES_ED_ENERGY_POINT_STORE_H_
#define CERES_ED_ENERGY_POINT_STORE_H_

#include <ceres_ed/energy/residual_store.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <cost_functions/warped_point_cost.h>

namespace ceres_ed {

// A point at rest, in map units, and the number of nodes to which it is bound. The blocks of its
// residual are these nodes, then, with a camera, R_c and T_c.
struct StoredPoint {
  Eigen::Vector3d position;
  // The index of the point in the context. If two are equal, the points are probably the same.
  int index = -1;
  // The index of its first weight in the store.
  int first_weight = 0;
  int num_nodes = 0;
  bool has_camera = false;
};

class BatchPointStore;

// The common part of all stores of point functors.
class PointStore : public ResidualStore {
 public:
  // The point of residual `index`.
  const StoredPoint& point(int index) const { return points_[index]; }
  // The weights w_i(v), one for each node.
  const double* weights(int index) const { return &weights_[points_[index].first_weight]; }

  // Evaluates the residuals `indices[k]`, for k < count, at the warped points `warped` (3 numbers
  // each). Writes num_residuals() numbers for each and, unless `jacobians` is null, their
  // derivatives with respect to the point (row-major). Returns false if one can't be evaluated.
  virtual bool EvaluateAtPoints(int count,
                                const int* indices,
                                const double* warped,
                                double* residuals,
                                double* jacobians) const = 0;

  // Returns this store if its residuals are to be evaluated all at once (batch_store.h), else
  // null.
  virtual const BatchPointStore* AsBatch() const { return nullptr; }

  void Clear() override {
    ResidualStore::Clear();
    points_.clear();
    weights_.clear();
  }

  bool Evaluate(int index,
                const BlockRef* blocks,
                const DeformationGraph& graph,
                const DeformationState& state,
                double* residuals) const override {
    const StoredPoint& point = points_[index];
    std::array<const double*, kMaxBoundNodes> nodes;
    for (int i = 0; i < point.num_nodes; ++i) nodes[i] = state.node(blocks[i].node);
    Eigen::Vector3d warped = WarpToMap(Bind(index, blocks, graph), nodes.data());
    if (point.has_camera) warped = state.camera_from_map * warped;
    return EvaluateAtPoints(1, &index, warped.data(), residuals, nullptr);
  }

 protected:
  explicit PointStore(int num_residuals) : ResidualStore(Form::kPoint, num_residuals) {}

  void AddPoint(const Eigen::Vector3d& position, int index, const Binding& binding, bool camera) {
    const int first_weight = static_cast<int>(weights_.size());
    points_.push_back({position, index, first_weight, binding.size, camera});
    weights_.insert(weights_.end(), binding.weights, binding.weights + binding.size);
    CountOne();
  }

  // Returns the point with the weights and positions of its nodes.
  BoundPoint Bind(int index, const BlockRef* blocks, const DeformationGraph& graph) const {
    return BoundPoint(
        points_[index].position,
        points_[index].num_nodes,
        weights(index),
        [&](int i) -> const Eigen::Vector3d& { return graph.position(blocks[i].node); });
  }

 private:
  std::vector<StoredPoint> points_;
  std::vector<double> weights_;
};

// The store of one type of point functor (cost_functions/warped_point_cost.h).
template <typename Functor>
class FunctorPointStore final : public PointStore {
 public:
  FunctorPointStore() : PointStore(Functor::kNumResiduals) {}

  // Adds a residual. `index` is the index of the point in its context.
  void Add(Functor functor,
           const Eigen::Vector3d& position,
           int index,
           const Binding& binding,
           bool has_camera) {
    AddPoint(position, index, binding, has_camera);
    functors_.push_back(std::move(functor));
  }

  void Clear() override {
    PointStore::Clear();
    functors_.clear();
  }

  bool EvaluateAtPoints(int count,
                        const int* indices,
                        const double* warped,
                        double* residuals,
                        double* jacobians) const override {
    constexpr int kNumResiduals = Functor::kNumResiduals;
    for (int k = 0; k < count; ++k) {
      const Functor& functor = functors_[indices[k]];
      double* jacobian = jacobians != nullptr ? jacobians + 3 * kNumResiduals * k : nullptr;
      if (!EvaluatePointFunctor(functor, warped + 3 * k, residuals + kNumResiduals * k, jacobian)) {
        return false;
      }
    }
    return true;
  }

  std::unique_ptr<ceres::CostFunction> MakeCost(int index,
                                                const BlockRef* blocks,
                                                const DeformationGraph& graph) const override {
    return std::make_unique<WarpedPointCost<Functor>>(
        functors_[index], Bind(index, blocks, graph), point(index).has_camera);
  }

 private:
  std::vector<Functor> functors_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_POINT_STORE_H_
