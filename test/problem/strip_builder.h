// A test problem with its energies in a builder.
#ifndef CERES_ED_TEST_PROBLEM_STRIP_BUILDER_H_
#define CERES_ED_TEST_PROBLEM_STRIP_BUILDER_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {

// Returns a strip with points in the first two of five columns of cells, so that the first three of
// six columns of nodes are PR.
inline TestProblemOptions HalfSeen(bool has_camera = false, int points_per_cell = 1) {
  TestProblemOptions options;
  options.observed_columns = 2;
  options.points_per_cell = points_per_cell;
  options.has_camera = has_camera;
  options.target_deviation = 0.1;
  return options;
}

// A strip with its energies. Their weights have no common factors, so that a confusion is noticed.
struct StripBuilder {
  explicit StripBuilder(const TestProblemOptions& options, const std::string& data_energy = "")
      : problem(MakeTestProblem(options)), builder(problem.graph, options.has_camera) {
    rotation = Add("rotation", 1.5);
    regularization = Add("regularization", 2.5);
    data = Add(data_energy.empty() ? "point_to_point" : data_energy, 3.5);
  }
  StripBuilder(const StripBuilder&) = delete;
  StripBuilder& operator=(const StripBuilder&) = delete;

  // Returns the index of the term.
  int Add(const std::string& energy,
          double weight,
          const LossSpec& loss = {},
          const std::map<std::string, double>& parameters = {}) {
    const auto term = registry.Create(energy, parameters);
    CHECK(term.ok()) << term.status().message();
    const int index = builder.AddTerm(energy, (*term)->kind(), weight, loss);
    builder.CollectResiduals(index, **term, problem.Context());
    return index;
  }

  TestProblem problem;
  EnergyRegistry registry = BuiltinEnergies();
  ProblemBuilder builder;
  int rotation = -1;
  int regularization = -1;
  int data = -1;
};

// Returns the parameters of all nodes and of the camera, so that their bits can be compared.
inline std::vector<double> AllParameters(const DeformationState& state) {
  std::vector<double> all;
  for (int j = 0; j < state.num_nodes(); ++j) {
    all.insert(all.end(), state.node(j), state.node(j) + kNodeSize);
  }
  const CameraPose& camera = state.camera_from_map;
  all.insert(all.end(), camera.rotation.coeffs().data(), camera.rotation.coeffs().data() + 4);
  all.insert(all.end(), camera.translation.data(), camera.translation.data() + 3);
  return all;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_PROBLEM_STRIP_BUILDER_H_
