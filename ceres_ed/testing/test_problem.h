// Small graphs with points and observations, whose sizes can be computed by hand.
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

// A strip of `columns` x `rows` nodes, one unit apart and slightly wavy. Node column * rows + row
// is in the given column and row.
struct TestProblemOptions {
  // The size of the strip, >= 2 each.
  int columns = 6;
  int rows = 3;
  // The number of points in each cell between four nodes, to which each of them is bound.
  int points_per_cell = 1;
  // Only points in the first `observed_columns` columns of cells have a correspondence; -1 = all
  // points.
  int observed_columns = -1;
  bool has_camera = false;
  // The standard deviation of each correspondence's target from its point at rest, per axis; 0 = at
  // the point.
  double target_deviation = 0.0;
  std::uint64_t seed = 1;
};

// Everything to which an EnergyContext points, in one object. It can be copied; a context belongs
// to one copy.
struct TestProblem {
  DeformationGraph graph;
  std::vector<Eigen::Vector3d> points;
  Skinning skinning;
  std::vector<Correspondence> correspondences;
  // One for each correspondence: normals around +z, and a brightness that is the same on both sides
  // if the target is at the point.
  std::vector<MatchDetail> match_details;
  // Two landmarks: the first point and the last one.
  std::vector<Correspondence> landmarks;
  bool has_camera = false;
  // The identity.
  CameraPose camera_prior;
  // Zero for each node: at rest.
  std::vector<Eigen::Vector3d> node_prior;

  // Returns a context that refers to this object, which must outlive it.
  EnergyContext Context() const;

  // Moves all targets and turns their normals by a rigid motion.
  void MoveTargets(const CameraPose& motion);
};

// Returns the strip. It has edges of weight 1 between neighbours along rows and columns, in both
// directions: 2 * (columns - 1) * rows + 2 * columns * (rows - 1) edges. Normals are unit vectors
// around +z; the weights of correspondences are 1. The same options give the same problem.
TestProblem MakeTestProblem(const TestProblemOptions& options);

// Returns a state in which every node parameter differs from rest by Gaussian numbers of standard
// deviation `deviation`. With a camera, its translation and its rotation (a unit quaternion) do,
// too.
DeformationState RandomState(const TestProblem& problem, double deviation, std::uint64_t seed);

// Returns the state in which every node moves as x -> motion * x: A_j = R, t_j = R g_j + t - g_j.
// The camera is at rest.
DeformationState RigidState(const DeformationGraph& graph, const CameraPose& motion);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_TEST_PROBLEM_H_
