// Checks the sparsity of the paper's Jacobians on ceres::Problem.
#include <ceres_ed/problem/problem_builder.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>
#include <test/graph/matrix_form.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

// Returns the Jacobian of a single term, over all nodes in the given order, then the camera.
ceres::CRSMatrix JacobianOf(StripBuilder* strip,
                            int term,
                            const std::vector<int>& order,
                            DeformationState* state) {
  for (int t = 0; t < strip->builder.num_terms(); ++t) {
    if (t != term) strip->builder.SetWeight(t, 0.0);
  }
  const BuiltProblem built = strip->builder.Build(
      FullConfig(strip->problem.graph.num_nodes(), strip->builder.has_camera()), state);
  ceres::Problem::EvaluateOptions options;
  for (const int j : order) {
    if (!built.problem->HasParameterBlock(state->node(j))) {
      built.problem->AddParameterBlock(state->node(j), kNodeSize);
    }
    options.parameter_blocks.push_back(state->node(j));
  }
  double* rotation = state->camera_from_map.rotation.coeffs().data();
  if (built.problem->HasParameterBlock(rotation)) {
    options.parameter_blocks.push_back(rotation);
    options.parameter_blocks.push_back(state->camera_from_map.translation.data());
  }
  ceres::CRSMatrix jacobian;
  EXPECT_TRUE(built.problem->Evaluate(options, nullptr, nullptr, nullptr, &jacobian));
  return jacobian;
}

// Returns the node columns (column / 12) of each row.
std::vector<std::set<int>> NodesOfRows(const ceres::CRSMatrix& jacobian) {
  std::vector<std::set<int>> nodes(jacobian.num_rows);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    for (int i = jacobian.rows[row]; i < jacobian.rows[row + 1]; ++i) {
      nodes[row].insert(jacobian.cols[i] / kNodeSize);
    }
  }
  return nodes;
}

// Returns the PR nodes first, each kind from the last index to the first. The reverse order is
// needed since PR nodes have the low indices anyway.
std::vector<int> PointRelevantFirst(const std::vector<char>& relevant) {
  std::vector<int> order;
  for (int j = static_cast<int>(relevant.size()) - 1; j >= 0; --j) order.push_back(j);
  std::stable_partition(order.begin(), order.end(), [&](int j) { return relevant[j] != 0; });
  return order;
}

TEST(DataJacobian, HasNoColumnsOfPointIrrelevantNodes) {
  for (const std::string energy : {"point_to_point", "point_to_plane"}) {
    for (const bool has_camera : {false, true}) {
      StripBuilder strip(HalfSeen(has_camera, 2), energy);
      const std::vector<char> relevant = strip.builder.PointRelevantNodes();
      const std::vector<int> order = PointRelevantFirst(relevant);
      DeformationState state = RandomState(strip.problem, 0.3, 2);
      const ceres::CRSMatrix J = JacobianOf(&strip, strip.data, order, &state);
      const int num_relevant =
          static_cast<int>(std::count(relevant.begin(), relevant.end(), char{1}));
      ASSERT_EQ(num_relevant, 9);
      ASSERT_EQ(J.num_rows, (energy == "point_to_point" ? 3 : 1) * 8);
      ASSERT_EQ(J.num_cols, 18 * kNodeSize + (has_camera ? 6 : 0));
      std::set<int> columns(J.cols.begin(), J.cols.end());
      for (int column = 0; column < 18 * kNodeSize; ++column) {
        EXPECT_EQ(columns.count(column) != 0, column < num_relevant * kNodeSize) << column;
      }
      EXPECT_EQ(columns.lower_bound(18 * kNodeSize) != columns.end(), has_camera);
    }
  }
}

TEST(RotationJacobian, IsBlockDiagonal) {
  StripBuilder strip(HalfSeen(false, 2));
  const std::vector<int> order = PointRelevantFirst(strip.builder.PointRelevantNodes());
  DeformationState state = RandomState(strip.problem, 0.3, 2);
  const ceres::CRSMatrix J = JacobianOf(&strip, strip.rotation, order, &state);
  const std::vector<std::set<int>> nodes = NodesOfRows(J);
  ASSERT_EQ(J.num_rows, 6 * 18);
  for (int row = 0; row < J.num_rows; ++row) {
    // Residuals are in the order of the nodes.
    const auto place = std::find(order.begin(), order.end(), row / 6) - order.begin();
    EXPECT_EQ(nodes[row], std::set<int>{static_cast<int>(place)});
  }
}

TEST(RegularizationJacobian, JoinsTheTwoNodesOfEachEdge) {
  StripBuilder strip(HalfSeen(false, 2));
  std::vector<int> order;
  for (int j = 0; j < 18; ++j) order.push_back(j);
  DeformationState state = RandomState(strip.problem, 0.3, 2);
  const ceres::CRSMatrix J = JacobianOf(&strip, strip.regularization, order, &state);
  const std::vector<std::set<int>> nodes = NodesOfRows(J);
  ASSERT_EQ(J.num_rows, 3 * strip.problem.graph.num_edges());
  for (int row = 0; row < J.num_rows; ++row) {
    const GraphEdge& edge = strip.problem.graph.edges()[row / 3];
    EXPECT_EQ(nodes[row], (std::set<int>{edge.from, edge.to}));
    // Of node k only t_k has entries that are not zero: A_k is not part of Eq. 6.
    for (int i = J.rows[row]; i < J.rows[row + 1]; ++i) {
      const bool of_k = J.cols[i] / kNodeSize == edge.to;
      if (of_k && J.cols[i] % kNodeSize < kNodeTranslationOffset) {
        EXPECT_EQ(J.values[i], 0.0);
      }
    }
  }
}

// d E_data / d Phi = R_c Pi (Eq. 13): the matrix form gives the Jacobian of the data term by the
// nodes.
TEST(DataJacobian, IsThatOfTheMatrixForm) {
  StripBuilder strip(HalfSeen(true, 2));
  std::vector<int> order;
  for (int j = 0; j < 18; ++j) order.push_back(j);
  DeformationState state = RandomState(strip.problem, 0.3, 2);
  strip.builder.SetWeight(strip.data, 1.0);
  const ceres::CRSMatrix J = JacobianOf(&strip, strip.data, order, &state);
  const Eigen::MatrixXd Pi =
      MatrixPi(strip.problem.graph, strip.problem.skinning, strip.problem.points);
  const Eigen::Matrix3d R_c = state.camera_from_map.rotation.toRotationMatrix();
  for (int row = 0; row < J.num_rows; ++row) {
    const int point = strip.problem.correspondences[row / 3].point;
    for (int i = J.rows[row]; i < J.rows[row + 1]; ++i) {
      if (J.cols[i] >= 18 * kNodeSize) continue;
      const int node = J.cols[i] / kNodeSize;
      const int parameter = J.cols[i] % kNodeSize;
      const int column = parameter < 9 ? 3 * node + parameter / 3 : 3 * 18 + node;
      EXPECT_NEAR(J.values[i], R_c(row % 3, parameter % 3) * Pi(point, column), 1e-14);
    }
  }
}

}  // namespace
}  // namespace ceres_ed
