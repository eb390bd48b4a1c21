// Observations gathered by the nodes that carry them.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_POINT_GROUPS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_POINT_GROUPS_H_

#include <ceres_ed/energy/point_store.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/problem/problem_builder.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Residuals of one store and term on points of one group.
struct PointRun {
  const PointStore* store = nullptr;
  int term = -1;
  int first_residual = 0;
  int num_residuals = 0;
};

// Points that the same nodes carry.
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

// All residuals of point stores in a problem. Residuals of several energies on one point share it.
class PointGroups {
 public:
  // Takes the residuals of point stores among `residuals`; keeps the memory of what was there.
  void Build(const DeformationGraph& graph, const std::vector<SelectedResidual>& residuals);

  const std::vector<PointGroup>& groups() const { return groups_; }
  // Of a group: its nodes, ascending, and v - (position of its first node) of each point.
  const int* nodes(const PointGroup& group) const { return &nodes_[group.first_node]; }
  const double* levers(const PointGroup& group) const { return levers_[group.first_point].data(); }
  // num_nodes a point.
  const double* weights(const PointGroup& group) const { return &weights_[group.first_weight]; }
  const PointRun* runs(const PointGroup& group) const { return &runs_[group.first_run]; }
  // Of a run, each residual: its number in the store, its point among those of the group, and the
  // weight of its term times its own.
  const int* indices(const PointRun& run) const { return &indices_[run.first_residual]; }
  const int* points(const PointRun& run) const { return &points_[run.first_residual]; }
  const double* residual_weights(const PointRun& run) const {
    return &residual_weights_[run.first_residual];
  }
  // The most points of a group, and the most residuals of one on a point.
  int max_points() const { return max_points_; }
  int max_residuals() const { return max_residuals_; }

 private:
  // A point as it came, and where it goes.
  struct Point {
    const PointStore* store = nullptr;
    const BlockRef* blocks = nullptr;
    int index = 0;
    int group = 0;
    int place = 0;
  };
  // The same point among those that came before; -1 where there is none.
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

  // While building. By the index of a point in its context, by place of a hash, and of each
  // residual of a point store.
  std::vector<int> point_of_index_;
  std::vector<int> group_table_;
  std::vector<Point> found_;
  std::vector<int> point_of_residual_;
  std::vector<int> next_residual_;
  std::vector<PointRun> placed_runs_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_POINT_GROUPS_H_
