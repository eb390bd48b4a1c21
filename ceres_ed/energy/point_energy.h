// Energies on warped points: functors that see a point, or several, and no graph.
#ifndef CERES_ED_ENERGY_POINT_ENERGY_H_
#define CERES_ED_ENERGY_POINT_ENERGY_H_

#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/optional_functor.h>
#include <ceres_ed/energy/point_store.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <cost_functions/warped_point_cost.h>
#include <cost_functions/warped_points_cost.h>

namespace ceres_ed {

// Where a functor sees its point.
enum class PointFrame {
  // In the camera frame where there is a camera: that of what was observed.
  kObserved,
  // In the map frame always.
  kMap,
};

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
// `weight` >= 0 multiplies its cost.
template <typename Functor>
void AddPointResidual(const EnergyContext& context,
                      int index,
                      Functor functor,
                      double weight,
                      ResidualSink* sink,
                      PointFrame frame = PointFrame::kObserved) {
  const Binding binding = (*context.skinning)[index];
  const bool has_camera = context.has_camera && frame == PointFrame::kObserved;
  std::array<BlockRef, kMaxBoundNodes + 2> blocks;
  int num_blocks = 0;
  for (int i = 0; i < binding.size; ++i) blocks[num_blocks++] = BlockRef::Node(binding.nodes[i]);
  if (has_camera) {
    blocks[num_blocks++] = BlockRef::CameraRotation();
    blocks[num_blocks++] = BlockRef::CameraTranslation();
  }
  if (auto* store = FindStore<FunctorPointStore<Functor>>(sink); store != nullptr) {
    store->Add(std::move(functor), (*context.points)[index], index, binding, has_camera);
    sink->AddStored(store, blocks.data(), num_blocks, weight);
    return;
  }
  sink->Add(std::make_unique<WarpedPointCost<Functor>>(
                std::move(functor), BindContextPoint(context, index), has_camera),
            blocks.data(),
            num_blocks,
            weight);
}

// Adds the residual of a functor on several points (cost_functions/warped_points_cost.h).
template <typename Functor, std::size_t kNumPoints>
void AddPointsResidual(const EnergyContext& context,
                       const std::array<int, kNumPoints>& indices,
                       Functor functor,
                       double weight,
                       ResidualSink* sink,
                       PointFrame frame = PointFrame::kObserved) {
  using Cost = WarpedPointsCost<Functor, static_cast<int>(kNumPoints)>;
  std::vector<BlockRef> blocks;
  const auto block_of = [&blocks](int node) {
    const auto found = std::find_if(
        blocks.begin(), blocks.end(), [node](const BlockRef& block) { return block.node == node; });
    if (found == blocks.end()) {
      blocks.push_back(BlockRef::Node(node));
      return static_cast<int>(blocks.size()) - 1;
    }
    return static_cast<int>(found - blocks.begin());
  };
  const auto bind = [&](int index) {
    typename Cost::Point point{BindContextPoint(context, index), {}};
    const Binding binding = (*context.skinning)[index];
    for (int i = 0; i < binding.size; ++i) point.blocks[i] = block_of(binding.nodes[i]);
    return point;
  };
  auto points = std::apply(
      [&bind](auto... index) {
        return std::array<typename Cost::Point, kNumPoints>{bind(index)...};
      },
      indices);
  const int num_nodes = static_cast<int>(blocks.size());
  const bool has_camera = context.has_camera && frame == PointFrame::kObserved;
  if (has_camera) {
    blocks.push_back(BlockRef::CameraRotation());
    blocks.push_back(BlockRef::CameraTranslation());
  }
  sink->Add(std::make_unique<Cost>(std::move(functor), std::move(points), num_nodes, has_camera),
            blocks.data(),
            static_cast<int>(blocks.size()),
            weight);
}

// One residual a point. `make(const EnergyContext&, int point)` returns its functor, or an optional
// one where some points have none.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachPoint(EnergyKind kind,
                                         MakeFunctor make,
                                         PointFrame frame = PointFrame::kObserved) {
  return MakeEnergy(kind, [make, frame](const EnergyContext& context, ResidualSink* sink) {
    for (int i = 0; i < static_cast<int>(context.points->size()); ++i) {
      VisitFunctor(make(context, i), [&](auto functor) {
        AddPointResidual(context, i, std::move(functor), 1.0, sink, frame);
      });
    }
  });
}

// One list of observations in a context: matched or given.
using CorrespondenceList = const std::vector<Correspondence>* EnergyContext::*;

// One residual a correspondence of `list`, with its weight. `make(const Correspondence&)` returns
// its point functor, or an optional one.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachCorrespondence(CorrespondenceList list, MakeFunctor make) {
  return MakeEnergy(EnergyKind::kObservation,
                    [list, make](const EnergyContext& context, ResidualSink* sink) {
                      for (const Correspondence& c : *(context.*list)) {
                        VisitFunctor(make(c), [&](auto functor) {
                          AddPointResidual(context, c.point, std::move(functor), c.weight, sink);
                        });
                      }
                    });
}

// The same of what was matched.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachMatch(MakeFunctor make) {
  return ForEachCorrespondence(&EnergyContext::correspondences, std::move(make));
}

// The same where more is known of a pair: `make(const Correspondence&, const MatchDetail&)`, with
// nothing known (MatchDetail()) where matching has left no detail.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachDetailedMatch(MakeFunctor make) {
  return MakeEnergy(
      EnergyKind::kObservation, [make](const EnergyContext& context, ResidualSink* sink) {
        const MatchDetail unknown;
        for (const Correspondence& c : *context.correspondences) {
          const bool known = context.match_details != nullptr && c.detail >= 0;
          const MatchDetail& detail = known ? (*context.match_details)[c.detail] : unknown;
          VisitFunctor(make(c, detail), [&](auto functor) {
            AddPointResidual(context, c.point, std::move(functor), c.weight, sink);
          });
        }
      });
}

// The same of what the user gave: landmarks.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachLandmark(MakeFunctor make) {
  return ForEachCorrespondence(&EnergyContext::landmarks, std::move(make));
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_POINT_ENERGY_H_
