// Small graphs with points and observations, made to be counted by hand.
#ifndef CERES_ED_TESTING_TEST_PROBLEM_H_
#define CERES_ED_TESTING_TEST_PROBLEM_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/skinning.h>

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A strip of nodes `columns` x `rows`, one unit apart and slightly wavy; node column * rows + row.
struct TestProblemOptions {
  // >= 2, >= 2.
  int columns = 6;
  int rows = 3;
  // In each cell between four nodes; the four carry every one of its points.
  int points_per_cell = 1;
  // Points in the first `observed_columns` columns of cells have a correspondence; -1 = in all.
  int observed_columns = -1;
  bool has_camera = false;
  // Deviation of each correspondence's target from its point at rest, per axis; 0 = at the point.
  double target_deviation = 0.0;
  std::uint64_t seed = 1;
};

// What an EnergyContext points at, in one piece. Copyable; contexts belong to one copy.
struct TestProblem {
  DeformationGraph graph;
  std::vector<Eigen::Vector3d> points;
  Skinning skinning;
  std::vector<Correspondence> correspondences;
  // One a correspondence: normals around +z, and brightness that is the same on both sides where
  // the target is at the point.
  std::vector<MatchDetail> match_details;
  // The first point and the last.
  std::vector<Correspondence> landmarks;
  bool has_camera = false;
  // Identity.
  CameraPose camera_prior;
  // Zero, one a node: at rest.
  std::vector<Eigen::Vector3d> node_prior;

  // Looks at this object, which must outlive it.
  EnergyContext Context() const;

  // Moves all targets, and turns their normals, by a rigid motion.
  void MoveTargets(const CameraPose& motion);
};

// Returns the strip with edges of weight 1 between neighbours along rows and columns, both ways:
// 2 * (columns - 1) * rows + 2 * columns * (rows - 1) of them. Normals are unit vectors around +z;
// weights 1. The same options give the same problem.
TestProblem MakeTestProblem(const TestProblemOptions& options);

// Returns a state with every node parameter moved from rest by Gaussian numbers of `deviation`, and
// with a camera its translation and (as a unit quaternion) its rotation.
DeformationState RandomState(const TestProblem& problem, double deviation, std::uint64_t seed);

// Returns the state in which every node moves as x -> motion * x does: A_j = R, t_j = R g_j + t -
// g_j. The camera is at rest.
DeformationState RigidState(const DeformationGraph& graph, const CameraPose& motion);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_TEST_PROBLEM_H_
