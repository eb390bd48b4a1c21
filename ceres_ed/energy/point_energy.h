// Energies on warped points: their functors see one point or several, and no graph.
#ifndef CERES_ED_ENERGY_POINT_ENERGY_H_
#define CERES_ED_ENERGY_POINT_ENERGY_H_

#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/energy.h>
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

// The frame of the point that a functor sees.
enum class PointFrame {
  // The frame of the observations: the camera frame if there is a camera, otherwise the map frame.
  kObserved,
  // Always the map frame.
  kMap,
};

// Returns point `index` of the context with everything that is needed to warp it.
inline BoundPoint BindContextPoint(const EnergyContext& context, int index) {
  const Binding binding = (*context.skinning)[index];
  return BoundPoint(
      (*context.points)[index],
      binding.size,
      binding.weights,
      [&](int i) -> const Eigen::Vector3d& { return context.graph->position(binding.nodes[i]); });
}

// Adds the residual of a point functor (cost_functions/warped_point_cost.h) on point `index` of the
// context. `weight` >= 0 is a factor of its cost.
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
  // Use a store if the sink has one; otherwise make a cost function.
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

// Adds the residual of a functor on several points of the context
// (cost_functions/warped_points_cost.h). `weight` >= 0 is a factor of its cost. Points may share
// nodes.
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

// Returns an energy with one residual for each point. `make(const EnergyContext&, int point)`
// returns the functor, or an optional one if some points have no residual.
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

// A list of observations in a context: the matched ones or the given ones.
using CorrespondenceList = const std::vector<Correspondence>* EnergyContext::*;

// Returns an energy with one residual for each correspondence of `list`, with the weight of the
// correspondence. `make(const Correspondence&)` returns its point functor, or an optional one.
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

// Does the same for matched pairs.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachMatch(MakeFunctor make) {
  return ForEachCorrespondence(&EnergyContext::correspondences, std::move(make));
}

// Does the same for matched pairs of which more is known: `make(const Correspondence&, const
// MatchDetail&)`. If matching left no detail, it gets an empty one (MatchDetail()).
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

// Does the same for the pairs given by the user: landmarks.
template <typename MakeFunctor>
std::unique_ptr<EnergyTerm> ForEachLandmark(MakeFunctor make) {
  return ForEachCorrespondence(&EnergyContext::landmarks, std::move(make));
}

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_POINT_ENERGY_H_
