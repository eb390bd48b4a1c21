// Energies on parameter blocks: on nodes, on edges, on the camera, on any of them together.
//
// A functor is what Ceres differentiates, with one argument a block:
//   struct MyFunctor {
//     static constexpr int kNumResiduals = 3;
//     template <typename T> bool operator()(const T* node, T* residuals) const;
//   };
// A node's block is laid out as cost_functions/node_parameters.h says.
#ifndef CERES_ED_ENERGY_BLOCK_ENERGY_H_
#define CERES_ED_ENERGY_BLOCK_ENERGY_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/optional_functor.h>

#include <memory>
#include <utility>

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// Blocks whose sizes the compiler knows. A functor's argument for each of them:
// 12 numbers of a node,
struct NodeBlock {
  static constexpr int kSize = kNodeSize;
  int node = -1;

  BlockRef ref() const { return BlockRef::Node(node); }
};
// the unit quaternion x y z w of R_c (camera_from_map),
struct CameraRotationBlock {
  static constexpr int kSize = kRotationSize;

  BlockRef ref() const { return BlockRef::CameraRotation(); }
};
// and T_c, 3 numbers in map units.
struct CameraTranslationBlock {
  static constexpr int kSize = kTranslationSize;

  BlockRef ref() const { return BlockRef::CameraTranslation(); }
};

// Adds the residual of `functor` on `blocks`, which are its arguments in this order:
//   AddBlockResidual(sink, 1.0, MyFunctor{}, NodeBlock{j}, NodeBlock{k}, CameraRotationBlock{});
// `weight` >= 0 multiplies its cost.
template <typename Functor, typename... Blocks>
void AddBlockResidual(ResidualSink* sink, double weight, Functor functor, Blocks... blocks) {
  using Cost = ceres::AutoDiffCostFunction<Functor, Functor::kNumResiduals, Blocks::kSize...>;
  const BlockRef refs[] = {blocks.ref()...};
  sink->Add(std::make_unique<Cost>(new Functor(std::move(functor))),
            refs,
            static_cast<int>(sizeof...(Blocks)),
            weight);
}

// An energy whose residuals a function adds: `add(const EnergyContext&, ResidualSink*)`.
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

// The energy whose residuals `add` adds: any number, on any blocks and points.
template <typename Add>
std::unique_ptr<EnergyTerm> MakeEnergy(EnergyKind kind, Add add) {
  return std::make_unique<FunctionEnergy<Add>>(kind, std::move(add));
}

// One residual a node. `make(const EnergyContext&, int node)` returns its functor, or an optional
// one where some nodes have none; the functor sees the node: operator()(const T* node, T*).
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

// One residual an edge, of which there are two between neighbours, one each way.
// `make(const EnergyContext&, const GraphEdge&)` returns its functor, or an optional one; it sees
// both nodes: operator()(const T* from, const T* to, T*).
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
