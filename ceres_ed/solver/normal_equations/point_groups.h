// Observed points, grouped by the nodes to which they are bound.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_POINT_GROUPS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_POINT_GROUPS_H_

#include <ceres_ed/energy/point_store.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/problem/problem_builder.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A run of residuals of one store and one term on points of one group.
struct PointRun {
  const PointStore* store = nullptr;
  int term = -1;
  int first_residual = 0;
  int num_residuals = 0;
};

// The points that are bound to the same nodes.
struct PointGroup {
  int first_node = 0;
  int num_nodes = 0;
  bool has_camera = false;
  int first_point = 0;
  int num_points = 0;
  int first_weight = 0;
  int first_run = 0;
  int num_runs = 0;
};

// All residuals of point stores in a problem. Residuals of several energies on the same point share
// it.
class PointGroups {
 public:
  // Takes the residuals of point stores among `residuals`, and reuses the memory of the previous
  // ones.
  void Build(const DeformationGraph& graph, const std::vector<SelectedResidual>& residuals);

  const std::vector<PointGroup>& groups() const { return groups_; }
  // Return, for a group, its nodes in ascending order, and v - (position of its first node) of each
  // point.
  const int* nodes(const PointGroup& group) const { return &nodes_[group.first_node]; }
  const double* levers(const PointGroup& group) const { return levers_[group.first_point].data(); }
  // Returns the weights of the nodes, num_nodes values per point.
  const double* weights(const PointGroup& group) const { return &weights_[group.first_weight]; }
  const PointRun* runs(const PointGroup& group) const { return &runs_[group.first_run]; }
  // Return, for each residual of a run, its index in the store, its point among those of the group,
  // and the weight of its term times its own weight.
  const int* indices(const PointRun& run) const { return &indices_[run.first_residual]; }
  const int* points(const PointRun& run) const { return &points_[run.first_residual]; }
  const double* residual_weights(const PointRun& run) const {
    return &residual_weights_[run.first_residual];
  }
  // Return the largest number of points in a group, and the largest number of residuals of one
  // residual block on a point.
  int max_points() const { return max_points_; }
  int max_residuals() const { return max_residuals_; }

 private:
  // A point in the order of the residuals, and its place in a group.
  struct Point {
    const PointStore* store = nullptr;
    const BlockRef* blocks = nullptr;
    int index = 0;
    int group = 0;
    int place = 0;
  };
  // Returns an earlier point that equals the point of this residual, or -1 if there is none.
  int FindPoint(const SelectedResidual& residual, const PointStore& store);
  int FindOrAddGroup(const int* sorted_nodes, int num_nodes, bool has_camera);
  int AddPoint(const SelectedResidual& residual, const PointStore& store);
  void GrowGroupTable();
  void PlacePoints(const DeformationGraph& graph);
  void PlaceResiduals(const std::vector<SelectedResidual>& residuals);

  std::vector<PointGroup> groups_;
  std::vector<int> nodes_;
  std::vector<Eigen::Vector3d> levers_;
  std::vector<double> weights_;
  std::vector<PointRun> runs_;
  std::vector<int> indices_;
  std::vector<int> points_;
  std::vector<double> residual_weights_;
  int max_points_ = 0;
  int max_residuals_ = 0;

  // Used only while building: the point of each index in the context, the hash table of groups, all
  // points that were found, and the point of each residual of a point store.
  std::vector<int> point_of_index_;
  std::vector<int> group_table_;
  std::vector<Point> found_;
  std::vector<int> point_of_residual_;
  std::vector<int> next_residual_;
  std::vector<PointRun> placed_runs_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_POINT_GROUPS_H_
