// The laws that every energy obeys, built in or from a plugin, checked without a test framework.
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

// A motion of graph and camera that an energy does not see.
struct EnergyInvariance {
  // Ends the sentence "the energy changes under ...".
  std::string name;
  std::function<void(const DeformationGraph& graph, DeformationState* state)> motion;
};

// What an energy says of itself, and on what it is tried.
struct EnergyClaims {
  // Parameters to create it with; the defaults for the rest.
  std::map<std::string, double> parameters;
  // |r|^2 of each residual while the state is at rest and every correspondence and landmark sits on
  // its point, and the least that it can be; nothing where no minimum is claimed.
  std::optional<double> squared_norm_at_rest = 0.0;
  std::vector<EnergyInvariance> invariances;
  // The problem that residuals are asked for, with a camera and without one.
  TestProblemOptions problem;
  // Residuals of each context that go through the cost laws, evenly spread over all; >= 1.
  int max_residuals = 8;
  CostLawOptions cost;
};

// Returns one sentence for each violated law; empty when all hold:
//   - what the registry says of it is complete: summary, equation and unit are there, parameter
//     names are snake_case, once each and none of weight, loss, loss_width, each with a unit, a doc
//     and its default in its range;
//   - every parameter arrives as it was given: both ends of its range create the energy, beyond
//     them, a fraction for a whole number, and an unknown parameter are refused; each is asked for,
//     and the term's kind is the registered one;
//   - with a camera or without one it adds residuals; each touches at least one block (node or
//     camera), none twice, all of them there, with sizes that fit and a weight >= 0; none touches a
//     camera that isn't there;
//   - asked twice it adds the same, to the bit;
//   - its residuals obey CheckCostLaws, around rest and with targets that are off;
//   - the claimed motions leave its sum of squares as it is;
//   - zero normals, targets 1e6 units away, several nodes at one place, pairs without details and
//     empty lists leave everything finite.
std::vector<std::string> CheckEnergyLaws(const EnergyRegistry& registry,
                                         const std::string& name,
                                         const EnergyClaims& claims = {});

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_ENERGY_LAWS_H_
