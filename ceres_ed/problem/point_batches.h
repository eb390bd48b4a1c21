// The residuals of a problem that batch functions evaluate, all at once.
#ifndef CERES_ED_PROBLEM_POINT_BATCHES_H_
#define CERES_ED_PROBLEM_POINT_BATCHES_H_

#include <ceres_ed/energy/batch_store.h>
#include <ceres_ed/problem/problem_builder.h>

#include <vector>

namespace ceres_ed {

// Collects the residuals of each batch store (energy/batch_store.h), evaluates them in one call,
// and hands the values out one by one. One object serves one thread at a time while it evaluates;
// afterwards any number of threads may read the values.
class PointBatches {
 public:
  // Takes the residuals of batch stores among `residuals`. The graph, the stores and the blocks
  // must outlive this object.
  void Build(const DeformationGraph& graph, const std::vector<SelectedResidual>& residuals);
  void Clear() { batches_.clear(); }

  bool empty() const { return batches_.empty(); }

  // Evaluates all of them at `state`. Returns false if a function fails.
  bool Evaluate(const DeformationState& state);

  // Return the values of residual `index` of a store, and their derivatives with respect to the
  // warped point (row-major, num_residuals x 3). Null if the store is not a batch store. Valid
  // until the next call of Evaluate().
  const double* Residuals(const ResidualStore* store, int index) const;
  const double* Jacobian(const ResidualStore* store, int index) const;

 private:
  struct Batch {
    const BatchPointStore* store = nullptr;
    // In ascending order.
    std::vector<int> indices;
    std::vector<const BlockRef*> blocks;
    // The place of each residual of the store among `indices`.
    std::vector<int> row_of_index;
    std::vector<double> residuals;
    std::vector<double> jacobians;
  };
  const Batch* Find(const ResidualStore* store) const;

  const DeformationGraph* graph_ = nullptr;
  std::vector<Batch> batches_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_POINT_BATCHES_H_
