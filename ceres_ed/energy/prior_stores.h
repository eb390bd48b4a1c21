// The residuals of E_rot and E_reg, stored in arrays.
#ifndef CERES_ED_ENERGY_PRIOR_STORES_H_
#define CERES_ED_ENERGY_PRIOR_STORES_H_

#include <ceres_ed/energy/residual_store.h>

#include <memory>
#include <vector>

#include <cost_functions/regularization_cost.h>
#include <cost_functions/rotation_cost.h>

namespace ceres_ed {

// The residuals of E_rot (Eq. 5). Blocks: node j. They have no data, so only their number is
// stored.
class RotationStore final : public ResidualStore {
 public:
  RotationStore() : ResidualStore(Form::kRotation, RotationCost::kNumResiduals) {}

  // Adds the residual of one node.
  void Add() { CountOne(); }

  std::unique_ptr<ceres::CostFunction> MakeCost(int /*index*/,
                                                const BlockRef* /*blocks*/,
                                                const DeformationGraph& /*graph*/) const override {
    return std::unique_ptr<ceres::CostFunction>(RotationCost::Create());
  }

  bool Evaluate(int /*index*/,
                const BlockRef* blocks,
                const DeformationGraph& /*graph*/,
                const DeformationState& state,
                double* residuals) const override {
    return RotationCost()(state.node(blocks[0].node), residuals);
  }
};

// The residuals of E_reg (Eq. 6). Blocks: nodes j and k of an edge.
class EdgeStore final : public ResidualStore {
 public:
  EdgeStore() : ResidualStore(Form::kEdge, RegularizationCost::kNumResiduals) {}

  // Adds the residual of one edge.
  void Add(const RegularizationCost& cost) {
    costs_.push_back(cost);
    CountOne();
  }

  const RegularizationCost& cost(int index) const { return costs_[index]; }

  void Clear() override {
    ResidualStore::Clear();
    costs_.clear();
  }

  std::unique_ptr<ceres::CostFunction> MakeCost(int index,
                                                const BlockRef* /*blocks*/,
                                                const DeformationGraph& /*graph*/) const override {
    return std::unique_ptr<ceres::CostFunction>(costs_[index].MakeCostFunction());
  }

  bool Evaluate(int index,
                const BlockRef* blocks,
                const DeformationGraph& /*graph*/,
                const DeformationState& state,
                double* residuals) const override {
    return costs_[index](state.node(blocks[0].node), state.node(blocks[1].node), residuals);
  }

 private:
  std::vector<RegularizationCost> costs_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_PRIOR_STORES_H_
