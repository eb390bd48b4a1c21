#include "ceres_ed/registration/uncertainty/statistical_weights.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// The smallest standard deviations: of a distance between surfaces as a part of the node spacing
// (what nodes cannot follow), of a landmark and of a fixed point in unit lengths, of an entry of
// E_rot, and of a strain.
constexpr double kLeastDistance = 0.02;
constexpr double kLeastLandmark = 0.005;
constexpr double kLeastPinned = 1e-4;
constexpr double kLeastRotation = 1e-3;
constexpr double kLeastStrain = 3e-3;
// How far a surface may have slid along itself.
constexpr double kSliding = 0.1;
// E_reg counts half: each edge is there in both directions.
constexpr double kDirections = 2.0;
constexpr int kRotationRows = 6;
constexpr int kPointRows = 3;
// Which pairs of nodes tell how a deformation varies over the body, and the number of nodes that
// are looked at, evenly spread over all.
constexpr double kNearPair = 0.1;
constexpr double kFarPair = 0.4;
constexpr int kMaxNodes = 400;

// A weighted mean of squared residuals.
struct MeanSquare {
  double sum = 0.0;
  double weight = 0.0;

  double AtLeast(double deviation) const {
    return std::max(weight > 0.0 ? sum / weight : 0.0, deviation * deviation);
  }
};

// Adds a residual whose nodes are all observed.
void AddResidual(const SelectedResidual& residual,
                 const ProblemBuilder& builder,
                 const DeformationState& state,
                 const std::vector<char>& is_observed,
                 MeanSquare* mean) {
  std::vector<const double*> blocks;
  blocks.reserve(residual.num_blocks);
  for (int i = 0; i < residual.num_blocks; ++i) {
    const BlockRef& block = residual.blocks[i];
    if (block.kind == BlockRef::Kind::kNode && is_observed[block.node] == 0) return;
    blocks.push_back(BlockPointer(state, block));
  }
  const std::shared_ptr<const ceres::CostFunction> cost = residual.CostFunction(builder.graph());
  Eigen::VectorXd r(cost->num_residuals());
  if (!cost->Evaluate(blocks.data(), r.data(), nullptr)) return;
  double rho[3] = {r.squaredNorm(), 1.0, 0.0};
  if (const auto loss = MakeLoss(builder.loss(residual.term)); loss != nullptr) {
    loss->Evaluate(r.squaredNorm(), rho);
  }
  const double weight = rho[1] * residual.weight / builder.weight(residual.term);
  mean->sum += weight * r.squaredNorm();
  mean->weight += weight;
}

// Returns the mean square strain between distant observed nodes.
MeanSquare DistantStrain(const DeformationGraph& graph,
                         const DeformationState& state,
                         const std::vector<char>& is_observed) {
  std::vector<int> nodes;
  for (int j = 0; j < graph.num_nodes(); ++j) {
    if (is_observed[j] != 0) nodes.push_back(j);
  }
  const std::size_t stride = 1 + nodes.size() / kMaxNodes;
  MeanSquare strain;
  for (std::size_t a = 0; a < nodes.size(); a += stride) {
    const double* node = state.node(nodes[a]);
    for (std::size_t b = 0; b < nodes.size(); b += stride) {
      const Eigen::Vector3d offset = graph.position(nodes[b]) - graph.position(nodes[a]);
      const double length = offset.norm();
      if (length < kNearPair || length > kFarPair) continue;
      const Eigen::Vector3d r = NodeAffine(node) * offset + NodeTranslation(node) - offset -
                                NodeTranslation(state.node(nodes[b]));
      strain.sum += r.squaredNorm() / (length * length);
      strain.weight += 1.0;
    }
  }
  return strain;
}

}  // namespace

std::vector<double> StatisticalWeights(const FitProblem& problem,
                                       const BuiltGraph& graph,
                                       const DeformationState& state) {
  const ProblemBuilder& builder = problem.builder();
  const std::vector<char> is_observed = builder.PointRelevantNodes();
  const auto num_observed = static_cast<double>(std::count_if(
      is_observed.begin(), is_observed.end(), [](char observed) { return observed != 0; }));
  std::vector<MeanSquare> means(builder.num_terms());
  std::vector<int> num_blocks(builder.num_terms(), 0);
  const ProblemConfig config = FullConfig(graph.graph.num_nodes(), builder.has_camera());
  for (const SelectedResidual& residual : builder.Select(config)) {
    if (residual.term < 0) continue;
    num_blocks[residual.term] = std::max(num_blocks[residual.term], residual.num_blocks);
    AddResidual(residual, builder, state, is_observed, &means[residual.term]);
  }
  const double spacing = graph.node_spacing;
  std::vector<double> weights;
  for (int term = 0; term < builder.num_terms(); ++term) {
    const TermRule& rule = problem.rule(term);
    const MeanSquare& mean = means[term];
    double weight = builder.weight(term);
    if (weight == 0.0) {
      // It is switched off.
    } else if (rule.stiff && num_blocks[term] > 1) {
      const double strain = DistantStrain(graph.graph, state, is_observed).AtLeast(kLeastStrain);
      weight = kPointRows / (kDirections * strain * spacing * spacing);
    } else if (rule.stiff) {
      weight = kRotationRows / mean.AtLeast(kLeastRotation);
    } else if (rule.matched && rule.thinned) {
      weight = 1.0 / (kSliding * kSliding);
    } else if (rule.matched) {
      weight = num_observed / mean.AtLeast(kLeastDistance * spacing);
    } else if (!rule.is_users) {
      const bool is_pinned = rule.pairs == PairSource::kPinned;
      weight = kPointRows / mean.AtLeast(is_pinned ? kLeastPinned : kLeastLandmark);
    }
    weights.push_back(weight);
  }
  return weights;
}

}  // namespace ceres_ed
