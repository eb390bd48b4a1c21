// Energies that see a warped point, not a graph.
#ifndef CERES_ED_ENERGY_POINT_ENERGY_H_
#define CERES_ED_ENERGY_POINT_ENERGY_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/point_store.h>

#include <array>
#include <memory>
#include <utility>

#include <cost_functions/warped_point_cost.h>

namespace ceres_ed {

// The point `index` of the context with all that its warp needs.
inline BoundPoint BindContextPoint(const EnergyContext& context, int index) {
  const Binding binding = (*context.skinning)[index];
  return BoundPoint(
      (*context.points)[index],
      binding.size,
      binding.weights,
      [&](int i) -> const Eigen::Vector3d& { return context.graph->position(binding.nodes[i]); });
}

// Adds the residual of a point functor (cost_functions/warped_point_cost.h) on point `index`.
template <typename Functor>
void AddPointResidual(
    const EnergyContext& context, int index, Functor functor, double weight, ResidualSink* sink) {
  const Binding binding = (*context.skinning)[index];
  std::array<BlockRef, kMaxBoundNodes + 2> blocks;
  int num_blocks = 0;
  for (int i = 0; i < binding.size; ++i) blocks[num_blocks++] = BlockRef::Node(binding.nodes[i]);
  if (context.has_camera) {
    blocks[num_blocks++] = BlockRef::CameraRotation();
    blocks[num_blocks++] = BlockRef::CameraTranslation();
  }
  if (auto* store = FindStore<FunctorPointStore<Functor>>(sink); store != nullptr) {
    store->Add(std::move(functor), (*context.points)[index], index, binding, context.has_camera);
    sink->AddStored(store, blocks.data(), num_blocks, weight);
    return;
  }
  sink->Add(std::make_unique<WarpedPointCost<Functor>>(
                std::move(functor), BindContextPoint(context, index), context.has_camera),
            blocks.data(),
            num_blocks,
            weight);
}

// One list of observations in a context: matched or given.
using CorrespondenceList = const std::vector<Correspondence>* EnergyContext::*;

// An observation energy with one functor a correspondence. `make_functor(const Correspondence&)`
// returns the point functor.
template <typename MakeFunctor>
class PointEnergy final : public EnergyTerm {
 public:
  PointEnergy(CorrespondenceList list, MakeFunctor make_functor)
      : list_(list), make_functor_(std::move(make_functor)) {}

  EnergyKind kind() const override { return EnergyKind::kObservation; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    for (const Correspondence& correspondence : *(context.*list_)) {
      AddPointResidual(context,
                       correspondence.point,
                       make_functor_(correspondence),
                       correspondence.weight,
                       sink);
    }
  }

 private:
  CorrespondenceList list_;
  MakeFunctor make_functor_;
};

template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> MakePointEnergy(CorrespondenceList list, MakeFunctor make_functor) {
  return std::make_unique<PointEnergy<MakeFunctor>>(list, std::move(make_functor));
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_POINT_ENERGY_H_
