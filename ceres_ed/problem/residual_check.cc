// The part of ProblemBuilder that finds the residual because of which a solver fails.
#include <ceres_ed/problem/point_batches.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/util/describe_throw.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {
namespace {

// Returns a text such as " (node 3, node 8)".
std::string DescribeBlocks(const BlockRef* blocks, int num_blocks) {
  std::string text;
  for (int i = 0; i < num_blocks; ++i) {
    text += text.empty() ? " (" : ", ";
    text += blocks[i].kind == BlockRef::Kind::kNode ? "node " + std::to_string(blocks[i].node)
                                                    : "camera";
  }
  return text.empty() ? "" : text + ")";
}

bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// Returns what is wrong with a cost function at `blocks`; empty if nothing is.
std::string FindFault(const ceres::CostFunction& cost, const std::vector<const double*>& blocks) {
  std::vector<double> residuals(cost.num_residuals(), 0.0);
  std::vector<std::vector<double>> jacobians;
  std::vector<double*> pointers;
  for (const int size : cost.parameter_block_sizes()) {
    jacobians.emplace_back(static_cast<std::size_t>(size) * residuals.size(), 0.0);
    pointers.push_back(jacobians.back().data());
  }
  bool valid = false;
  std::string thrown = DescribeThrow(
      [&] { valid = cost.Evaluate(blocks.data(), residuals.data(), pointers.data()); });
  if (!thrown.empty()) return thrown;
  if (!valid) return "says that it can't be evaluated";
  if (!AllFinite(residuals)) return "is not finite";
  for (const std::vector<double>& jacobian : jacobians) {
    if (!AllFinite(jacobian)) return "has a derivative that is not finite";
  }
  return "";
}

// Returns whether all residuals of batch functions and their derivatives are finite.
bool IsSound(const DeformationGraph& graph,
             const std::vector<SelectedResidual>& residuals,
             const DeformationState& state) {
  PointBatches batches;
  batches.Build(graph, residuals);
  bool valid = false;
  const std::string thrown = DescribeThrow([&] { valid = batches.Evaluate(state); });
  if (!valid || !thrown.empty()) return false;
  return std::all_of(residuals.begin(), residuals.end(), [&](const SelectedResidual& residual) {
    const int size = residual.num_residuals();
    return Eigen::Map<const Eigen::VectorXd>(batches.Residuals(residual.store, residual.index),
                                             size)
               .allFinite() &&
           Eigen::Map<const Eigen::VectorXd>(batches.Jacobian(residual.store, residual.index),
                                             3 * size)
               .allFinite();
  });
}

}  // namespace

Status ProblemBuilder::CheckResidual(const Term& term,
                                     int index,
                                     const DeformationState& state) const {
  const Residual& residual = term.residuals[index];
  const SelectedResidual selected = term.Selected(residual);
  std::vector<const double*> blocks;
  blocks.reserve(residual.num_blocks);
  for (int i = 0; i < residual.num_blocks; ++i) {
    blocks.push_back(BlockPointer(state, selected.blocks[i]));
  }
  const std::string fault = FindFault(*selected.CostFunction(graph_), blocks);
  if (fault.empty()) return Status::Ok();
  return Status::Error(DescribeEnergy(term.label, term.origin) + ": residual " +
                       std::to_string(index) +
                       DescribeBlocks(selected.blocks, selected.num_blocks) + " " + fault);
}

Status ProblemBuilder::CheckResiduals(const DeformationState& state) const {
  if (Status collected = status(); !collected.ok()) return collected;
  for (const Term& term : terms_) {
    if (term.weight == 0.0) continue;
    if (IsBatch(term)) {
      // A batch is looked at residual by residual only if there is something to find.
      std::vector<SelectedResidual> all;
      for (const Residual& residual : term.residuals) all.push_back(term.Selected(residual));
      if (IsSound(graph_, all, state)) continue;
    }
    for (int i = 0; i < static_cast<int>(term.residuals.size()); ++i) {
      if (Status checked = CheckResidual(term, i, state); !checked.ok()) return checked;
    }
  }
  return Status::Ok();
}

}  // namespace ceres_ed
