// What users see of a problem: how its seam is treated, and what its energies come to.
#ifndef CERES_ED_PROBLEM_PROBLEM_TYPES_H_
#define CERES_ED_PROBLEM_PROBLEM_TYPES_H_

#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>
#include <vector>

namespace ceres_ed {

// What happens to a prior residual between a variable and a held node.
enum class SeamEdges {
  // It stays, and pulls toward where the held node was ("fixing Phi_2", Eq. 14).
  kKeep,
  // It is left out, as in the paper's figure on node types. The seam may tear.
  kCut,
};

constexpr std::array<NamedValue<SeamEdges>, 2> NamesOf(SeamEdges) {
  return {{{"keep", SeamEdges::kKeep}, {"cut", SeamEdges::kCut}}};
}

// The cost of one term. With the sum over residual blocks i of the term:
struct TermEnergy {
  std::string label;
  // sum_i weight * weight_i * rho(|r_i|^2) / 2: what Ceres minimises.
  double weighted = 0.0;
  // sum_i |r_i|^2 / 2, free of weights and losses.
  double raw = 0.0;
  // Number of scalar residuals.
  int residuals = 0;
};

// The costs of all terms at one state.
struct EnergySummary {
  std::vector<TermEnergy> terms;

  // The objective (Eq. 3), half of it as Ceres counts.
  double Total() const;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_PROBLEM_TYPES_H_
