// Energies on parameter blocks: on nodes, edges, the camera, or several of them together.
//
// A functor is what Ceres differentiates. It has one argument for each block:
//   struct MyFunctor {
//     static constexpr int kNumResiduals = 3;
//     template <typename T> bool operator()(const T* node, T* residuals) const;
//   };
// The layout of a node's block is described in cost_functions/node_parameters.h.
#ifndef CERES_ED_ENERGY_BLOCK_ENERGY_H_
#define CERES_ED_ENERGY_BLOCK_ENERGY_H_

#include <ceres_ed/energy/energy.h>

#include <memory>
#include <optional>
#include <utility>

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// Calls visit(functor) if there is a functor. A function that makes functors may return an
// std::optional to leave some out.
template <typename Functor, typename Visit>
void VisitFunctor(Functor functor, const Visit& visit) {
  visit(std::move(functor));
}
template <typename Functor, typename Visit>
void VisitFunctor(std::optional<Functor> functor, const Visit& visit) {
  if (functor.has_value()) visit(*std::move(functor));
}

// Blocks whose sizes the compiler knows. The functor gets one argument for each of them.
//
// A node: 12 numbers.
struct NodeBlock {
  static constexpr int kSize = kNodeSize;
  int node = -1;

  BlockRef ref() const { return BlockRef::Node(node); }
};
// The rotation R_c of camera_from_map: a unit quaternion x y z w.
struct CameraRotationBlock {
  static constexpr int kSize = kRotationSize;

  BlockRef ref() const { return BlockRef::CameraRotation(); }
};
// The translation T_c of camera_from_map: 3 numbers in map units.
struct CameraTranslationBlock {
  static constexpr int kSize = kTranslationSize;

  BlockRef ref() const { return BlockRef::CameraTranslation(); }
};

// Adds the residual of `functor` on `blocks`, which become its arguments in this order:
//   AddBlockResidual(sink, 1.0, MyFunctor{}, NodeBlock{j}, NodeBlock{k}, CameraRotationBlock{});
// `weight` >= 0 is a factor of its cost.
template <typename Functor, typename... Blocks>
void AddBlockResidual(ResidualSink* sink, double weight, Functor functor, Blocks... blocks) {
  using Cost = ceres::AutoDiffCostFunction<Functor, Functor::kNumResiduals, Blocks::kSize...>;
  const BlockRef refs[] = {blocks.ref()...};
  sink->Add(std::make_unique<Cost>(new Functor(std::move(functor))),
            refs,
            static_cast<int>(sizeof...(Blocks)),
            weight);
}

// An energy whose residuals are added by a function `add(const EnergyContext&, ResidualSink*)`.
template <typename Add>
class FunctionEnergy final : public EnergyTerm {
 public:
  FunctionEnergy(EnergyKind kind, Add add) : kind_(kind), add_(std::move(add)) {}

  EnergyKind kind() const override { return kind_; }
  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    add_(context, sink);
  }

 private:
  EnergyKind kind_;
  Add add_;
};

// Returns an energy whose residuals are added by `add`: any number, on any blocks and points.
template <typename Add>
std::unique_ptr<EnergyTerm> MakeEnergy(EnergyKind kind, Add add) {
  return std::make_unique<FunctionEnergy<Add>>(kind, std::move(add));
}

// Returns an energy with one residual for each node. `make(const EnergyContext&, int node)` returns
// the functor, or an optional one if some nodes have no residual. The functor sees the node:
// operator()(const T* node, T*).
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachNode(EnergyKind kind, MakeFunctor make) {
  return MakeEnergy(kind, [make](const EnergyContext& context, ResidualSink* sink) {
    for (int j = 0; j < context.graph->num_nodes(); ++j) {
      VisitFunctor(make(context, j), [&](auto functor) {
        AddBlockResidual(sink, 1.0, std::move(functor), NodeBlock{j});
      });
    }
  });
}

// Returns an energy with one residual for each directed edge. There are two edges between
// neighbours, one in each direction. `make(const EnergyContext&, const GraphEdge&)` returns the
// functor, or an optional one if some edges have no residual. The functor sees both nodes:
// operator()(const T* from, const T* to, T*).
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachEdge(EnergyKind kind, MakeFunctor make) {
  return MakeEnergy(kind, [make](const EnergyContext& context, ResidualSink* sink) {
    for (const GraphEdge& edge : context.graph->edges()) {
      VisitFunctor(make(context, edge), [&](auto functor) {
        AddBlockResidual(sink, 1.0, std::move(functor), NodeBlock{edge.from}, NodeBlock{edge.to});
      });
    }
  });
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_BLOCK_ENERGY_H_
