// Types of a problem for users: the treatment of its boundary, and the costs of its energies.
#ifndef CERES_ED_PROBLEM_PROBLEM_TYPES_H_
#define CERES_ED_PROBLEM_PROBLEM_TYPES_H_

#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>
#include <vector>

namespace ceres_ed {

// What happens to a prior residual between a variable node and a constant one.
enum class BoundaryEdges {
  // It is kept, and pulls toward the position of the constant node ("fixing Phi_2", Eq. 14).
  kKeep,
  // It is left out, as in the paper's figure on node types. The surface may tear at the boundary.
  kCut,
};

constexpr std::array<NamedValue<BoundaryEdges>, 2> NamesOf(BoundaryEdges) {
  return {{{"keep", BoundaryEdges::kKeep}, {"cut", BoundaryEdges::kCut}}};
}

// The cost of one term. The sums are over its residual blocks i.
struct TermEnergy {
  std::string label;
  // sum_i weight * weight_i * rho(|r_i|^2) / 2, which Ceres minimises.
  double weighted = 0.0;
  // sum_i |r_i|^2 / 2, without weights and losses.
  double raw = 0.0;
  // The number of scalar residuals.
  int residuals = 0;
};

// The costs of all terms at one state.
struct EnergySummary {
  std::vector<TermEnergy> terms;

  // Returns the objective (Eq. 3), with the factor 1/2 of Ceres.
  double Total() const;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_PROBLEM_TYPES_H_
