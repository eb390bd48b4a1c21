// The laws that every energy must obey, whether it is built in or from a plugin. The checker needs
// no test framework.
//
//   for (const std::string& violation : CheckEnergyLaws(registry, "my_energy")) {
//     ADD_FAILURE() << violation;
//   }
#ifndef CERES_ED_TESTING_ENERGY_LAWS_H_
#define CERES_ED_TESTING_ENERGY_LAWS_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/testing/cost_laws.h>
#include <ceres_ed/testing/test_problem.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// A motion of graph and camera that does not change an energy.
struct EnergyInvariance {
  // The end of the sentence "the energy changes under ...".
  std::string name;
  // Applies the motion to the state.
  std::function<void(const DeformationGraph& graph, DeformationState* state)> motion;
};

// What an energy claims about itself, and the problem on which it is tried.
struct EnergyClaims {
  // The parameters with which it is created. The others have their defaults.
  std::map<std::string, double> parameters;
  // |r|^2 of each residual when the state is at rest and every correspondence and landmark is at
  // its point. It is the minimum over all states; no value if no minimum is claimed.
  std::optional<double> squared_norm_at_rest = 0.0;
  std::vector<EnergyInvariance> invariances;
  // The problem for which residuals are added, once with a camera and once without.
  TestProblemOptions problem;
  // The number of residuals of each context that are checked by the cost laws, >= 1. They are
  // spread evenly over all residuals.
  int max_residuals = 8;
  CostLawOptions cost;
};

// Returns one sentence for each violated law; empty if all laws hold:
//   - The description in the registry is complete: it has a summary, an equation and a unit.
//     Parameter names are snake_case, occur once, and are none of weight, loss, loss_width. Each
//     parameter has a unit, a doc, and a default in its range.
//   - Every parameter arrives as it was given. Both ends of its range create the energy. Values
//     beyond them, a fraction for an integer, and an unknown parameter are refused. Each parameter
//     is read, and the kind of the term is the registered one.
//   - With or without a camera the energy adds residuals. Each touches at least one block (node or
//     camera), none twice, and all of them exist. The sizes fit, and the weight is >= 0. Without a
//     camera no residual touches it.
//   - If it is asked twice, it adds the same residuals with the same bits.
//   - Its residuals obey CheckCostLaws(), around rest and with targets away from their points.
//   - The claimed motions do not change its sum of squares.
//   - With zero normals, targets 1e6 units away, several nodes at one place, pairs without details
//     and empty lists, everything is finite.
std::vector<std::string> CheckEnergyLaws(const EnergyRegistry& registry,
                                         const std::string& name,
                                         const EnergyClaims& claims = {});

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_ENERGY_LAWS_H_
