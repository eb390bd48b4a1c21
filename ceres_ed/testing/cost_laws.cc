#include "ceres_ed/testing/cost_laws.h"

#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// With more blocks than this, the subsets are too many to try all of them.
constexpr int kMaxBlocksForAllSubsets = 10;

struct NamedState {
  std::string name;
  ParameterBlocks blocks;
};

class LawChecker {
 public:
  LawChecker(const ceres::CostFunction& cost,
             const CostClaims& claims,
             const CostLawOptions& options)
      : cost_(cost), claims_(claims), options_(options) {}

  std::vector<std::string> Run() {
    if (!CheckShape()) return violations_;
    MakeStates();
    for (const NamedState& state : states_) {
      const CostEvaluation all = EvaluateCost(cost_, state.blocks, Mask(1));
      if (!CheckValues(state, all)) continue;
      CheckMinimum(state, all);
      CheckInvariances(state, all);
      CheckJacobians(state, all);
      CheckConstantBlocks(state, all);
    }
    CheckDegenerate();
    return violations_;
  }

 private:
  template <typename... Parts>
  void Report(const Parts&... parts) {
    std::ostringstream sentence;
    sentence.precision(12);
    (sentence << ... << parts);
    violations_.push_back(sentence.str());
  }

  int num_blocks() const { return static_cast<int>(claims_.rest.size()); }
  std::vector<char> Mask(char value) const { return std::vector<char>(num_blocks(), value); }

  bool CheckShape() {
    std::vector<int> sizes;
    for (const std::vector<double>& block : claims_.rest) {
      sizes.push_back(static_cast<int>(block.size()));
    }
    if (cost_.num_residuals() < 1) Report("the cost function has no residuals");
    if (sizes != cost_.parameter_block_sizes()) {
      Report("the cost function's block sizes are (",
             Join(cost_.parameter_block_sizes()),
             "), expected those of the state at rest (",
             Join(sizes),
             ")");
    }
    return violations_.empty();
  }

  static std::string Join(const std::vector<int>& values) {
    std::string joined;
    for (const int value : values) joined += (joined.empty() ? "" : ", ") + std::to_string(value);
    return joined;
  }

  void MakeStates() {
    states_.push_back({"at rest", claims_.rest});
    Random random(options_.seed);
    const auto add = [&](const char* name, double deviation) {
      for (int i = 0; i < options_.num_states; ++i) {
        NamedState state{name + std::to_string(i + 1), claims_.rest};
        for (std::vector<double>& block : state.blocks) {
          for (double& value : block) value += deviation * random.Gaussian();
        }
        if (claims_.normalize) claims_.normalize(&state.blocks);
        states_.push_back(std::move(state));
      }
    };
    add("near rest, state ", options_.near_deviation);
    add("at random, state ", options_.random_deviation);
  }

  bool CheckValues(const NamedState& state, const CostEvaluation& all) {
    if (all.overrun) Report(state.name, ": values are written behind the end of an array");
    if (all.IsFinite()) return true;
    Report(state.name,
           all.evaluated ? ": residuals or Jacobians are not finite, or not all are written"
                         : ": the evaluation fails");
    return false;
  }

  void CheckMinimum(const NamedState& state, const CostEvaluation& all) {
    if (!claims_.squared_norm_at_rest.has_value()) return;
    const double claimed = *claims_.squared_norm_at_rest;
    const double slack = options_.value_tolerance * std::max(1.0, claimed);
    const double found = all.residuals.squaredNorm();
    if (&state == &states_.front() && std::abs(found - claimed) > slack) {
      Report("at rest: |r|^2 is ", found, ", expected ", claimed);
    } else if (found < claimed - slack) {
      Report(state.name, ": |r|^2 is ", found, ", less than the ", claimed, " at rest");
    }
  }

  void CheckInvariances(const NamedState& state, const CostEvaluation& all) {
    for (const CostInvariance& invariance : claims_.invariances) {
      ParameterBlocks moved = state.blocks;
      invariance.motion(&moved);
      const CostEvaluation after = EvaluateResiduals(cost_, moved);
      const double change = invariance.of_norm_only
                                ? std::abs(after.residuals.norm() - all.residuals.norm())
                                : (after.residuals - all.residuals).norm();
      const double scale = std::max(1.0, all.residuals.norm());
      // The comparison treats NaN as a violation.
      if (after.evaluated && change <= options_.invariance_tolerance * scale) continue;
      Report(state.name, ": the residuals change by ", change, " under ", invariance.name);
    }
  }

  void CheckJacobians(const NamedState& state, const CostEvaluation& all) {
    for (int b = 0; b < num_blocks(); ++b) {
      const RowMajorMatrix numeric = NumericJacobian(cost_, state.blocks, b, options_.numeric_step);
      const double scale =
          std::max({1.0, numeric.cwiseAbs().maxCoeff(), all.residuals.cwiseAbs().maxCoeff()});
      Eigen::Index row = 0;
      Eigen::Index column = 0;
      const RowMajorMatrix difference = (all.jacobians[b] - numeric).cwiseAbs();
      const double largest = difference.maxCoeff<Eigen::PropagateNaN>(&row, &column);
      if (largest <= options_.jacobian_tolerance * scale) continue;
      Report(state.name,
             ": the Jacobian of block ",
             b,
             " is ",
             all.jacobians[b](row, column),
             " at residual ",
             row,
             ", parameter ",
             column,
             ", expected ",
             numeric(row, column),
             " (numeric differences)");
    }
  }

  void CheckConstantBlocks(const NamedState& state, const CostEvaluation& all) {
    for (const std::vector<char>& wanted : BlockSubsets()) {
      const CostEvaluation some = EvaluateCost(cost_, state.blocks, wanted);
      if (some.overrun) Report(state.name, ": values are written behind the end of an array");
      if (EqualToTheBit(all, some)) continue;
      std::vector<int> held;
      for (int b = 0; b < num_blocks(); ++b) {
        if (wanted[b] == 0) held.push_back(b);
      }
      Report(state.name,
             ": residuals or the other Jacobians change when blocks (",
             Join(held),
             ") are held constant");
      return;
    }
    const CostEvaluation none = EvaluateResiduals(cost_, state.blocks);
    const double scale = std::max(1.0, all.residuals.norm());
    if (none.overrun) Report(state.name, ": values are written behind the end of an array");
    if (!none.evaluated ||
        !((none.residuals - all.residuals).norm() <= options_.value_tolerance * scale)) {
      Report(state.name, ": the residuals are different when no Jacobians are asked for");
    }
  }

  // Returns the subsets to try. The set of all blocks is among them, since a second evaluation must
  // give the same values.
  std::vector<std::vector<char>> BlockSubsets() const {
    std::vector<std::vector<char>> subsets;
    if (num_blocks() <= kMaxBlocksForAllSubsets) {
      for (int bits = 0; bits < (1 << num_blocks()); ++bits) {
        std::vector<char> wanted = Mask(0);
        for (int b = 0; b < num_blocks(); ++b) wanted[b] = (bits >> b) & 1;
        subsets.push_back(std::move(wanted));
      }
      return subsets;
    }
    for (const char value : {0, 1}) {
      subsets.push_back(Mask(value));
      for (int b = 0; b < num_blocks(); ++b) {
        subsets.push_back(Mask(value));
        subsets.back()[b] = 1 - value;
      }
    }
    return subsets;
  }

  void CheckDegenerate() {
    ParameterBlocks zeros = claims_.rest;
    for (std::vector<double>& block : zeros) std::fill(block.begin(), block.end(), 0.0);
    CheckFinite("at all parameters zero", zeros);
    for (std::size_t i = 0; i < claims_.degenerate.size(); ++i) {
      CheckFinite("at degenerate state " + std::to_string(i + 1), claims_.degenerate[i]);
    }
  }

  void CheckFinite(const std::string& name, const ParameterBlocks& blocks) {
    CHECK_EQ(static_cast<int>(blocks.size()), num_blocks()) << name;
    CheckValues({name, blocks}, EvaluateCost(cost_, blocks, Mask(1)));
  }

  const ceres::CostFunction& cost_;
  const CostClaims& claims_;
  const CostLawOptions& options_;
  std::vector<NamedState> states_;
  std::vector<std::string> violations_;
};

}  // namespace

std::vector<double> RestNode() {
  std::vector<double> node(kNodeSize);
  SetNodeToRest(node.data());
  return node;
}

std::vector<double> CopyBlock(const double* values, int size) {
  return std::vector<double>(values, values + size);
}

std::vector<std::string> CheckCostLaws(const ceres::CostFunction& cost,
                                       const CostClaims& claims,
                                       const CostLawOptions& options) {
  return LawChecker(cost, claims, options).Run();
}

}  // namespace ceres_ed
