// Residuals on all warped points that one function evaluates at once.
#ifndef CERES_ED_ENERGY_BATCH_STORE_H_
#define CERES_ED_ENERGY_BATCH_STORE_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/point_store.h>

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The points that a batch function sees. Row k belongs to the point `indices[k]` of the context;
// indices ascend.
struct PointBatch {
  int count = 0;
  const int* indices = nullptr;
  // The warped points, 3 values each, in the frame that PointFrame names.
  const double* points = nullptr;
  // The unit normals of the warped surface at the points, 3 values each, in the same frame; zero
  // where the context has no normal.
  const double* normals = nullptr;
};

// A function of many points. Each row of its residuals depends on its own point only; the
// derivative with respect to the normal is taken as zero. May be called by several threads at once.
class PointBatchFunction {
 public:
  virtual ~PointBatchFunction() = default;

  // Returns the number of residuals of each point, given all points of the context at rest. Called
  // each time residuals are collected. May throw.
  virtual int NumResiduals(const PointBatch& at_rest) const = 0;

  // Writes the residuals (count x num_residuals) and their derivatives with respect to the points
  // (count x num_residuals x 3), both row-major. Returns false if they can't be evaluated.
  virtual bool Evaluate(const PointBatch& batch,
                        int num_residuals,
                        double* residuals,
                        double* jacobians) const = 0;
};

// The store of the residuals of one batch function.
class BatchPointStore final : public PointStore {
 public:
  BatchPointStore() : PointStore(/*num_residuals=*/0) {}

  void SetFunction(std::shared_ptr<const PointBatchFunction> function, int num_residuals);
  // Adds a residual. `normal` is the unit normal at rest, or zero.
  void Add(const Eigen::Vector3d& position,
           const Eigen::Vector3d& normal,
           int index,
           const Binding& binding,
           bool has_camera);

  const BatchPointStore* AsBatch() const override { return this; }
  void Clear() override;

  // Evaluates `count` residuals, which ascend, in one call. blocks[k] are the blocks of
  // indices[k]. Writes as PointBatchFunction::Evaluate() does.
  bool EvaluateAll(int count,
                   const int* indices,
                   const BlockRef* const* blocks,
                   const DeformationGraph& graph,
                   const DeformationState& state,
                   double* residuals,
                   double* jacobians) const;

  // The functions of all point stores. They call the function for few points, with normals at rest
  // (EvaluateAtPoints) or warped ones (Evaluate, MakeCost).
  bool EvaluateAtPoints(int count,
                        const int* indices,
                        const double* warped,
                        double* residuals,
                        double* jacobians) const override;
  bool Evaluate(int index,
                const BlockRef* blocks,
                const DeformationGraph& graph,
                const DeformationState& state,
                double* residuals) const override;
  std::unique_ptr<ceres::CostFunction> MakeCost(int index,
                                                const BlockRef* blocks,
                                                const DeformationGraph& graph) const override;

 private:
  std::shared_ptr<const PointBatchFunction> function_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_BATCH_STORE_H_
