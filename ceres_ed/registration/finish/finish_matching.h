// What pulls the vertices of a finish: pairs with the target, both ways.
#ifndef CERES_ED_REGISTRATION_FINISH_FINISH_MATCHING_H_
#define CERES_ED_REGISTRATION_FINISH_FINISH_MATCHING_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/registration/matching.h>

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the moving surface (a blend of up to three vertices), and the plane that it should
// reach: its distance is along `normal` for the most part.
struct FinishPair {
  std::array<int, 3> vertices = {-1, -1, -1};
  Eigen::Vector3d blend = Eigen::Vector3d::UnitX();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // Half way between the normals of the two surfaces.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double weight = 0.0;
};

// Finds the pairs of a finish, round after round.
class FinishMatcher {
 public:
  // All must outlive this. `fallback_normals`, one a vertex, serve where there are no triangles.
  FinishMatcher(const Surface& source,
                const WeldedMesh& mesh,
                const std::vector<Eigen::Vector3d>& fallback_normals,
                const Surface& target,
                const MatchingOptions& options);

  // The pairs of the vertices at `points`: of each vertex with the closest point of the target, and
  // of each target sample with the closest point of the moving surface. Believed as in
  // MatchBothWays. Where triangles span a curved surface, targets are moved by how far it lies from
  // them, as the normals of their corners tell. Weights are Welsch's with `loss_width` robust
  // standard deviations of the distances across the surface. They sum to at most the number of
  // vertices, each way half.
  // `points` is the same vector every time.
  std::vector<FinishPair> Match(const std::vector<Eigen::Vector3d>& points, double loss_width);

  // 1.4826 times the median distance across the surface of what was paired last.
  double robust_plane_distance() const { return robust_plane_distance_; }

 private:
  struct Candidate {
    FinishPair pair;
    double distance = 0.0;
    double plane = 0.0;
  };
  void MatchForward(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<Eigen::Vector3d>& normals,
                    std::vector<Candidate>* candidates);
  void MatchBackward(const std::vector<Eigen::Vector3d>& points,
                     const std::vector<Eigen::Vector3d>& normals,
                     std::vector<Candidate>* candidates);
  // Half way between two normals; zero where they disagree.
  Eigen::Vector3d Between(const Eigen::Vector3d& moving, const Eigen::Vector3d& still) const;

  const Surface& source_;
  const WeldedMesh& mesh_;
  const std::vector<Eigen::Vector3d>& fallback_normals_;
  const Surface& target_;
  const MatchingOptions& options_;
  std::vector<int> target_samples_;
  // What was closest in the round before: on the target to each vertex, and of the vertices to each
  // target sample; -1 where nothing was.
  std::vector<int> on_target_;
  std::vector<int> nearest_vertex_;
  std::unique_ptr<KdTree> tree_;
  double robust_plane_distance_ = 0.0;
  double min_cosine_;
  bool oriented_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FINISH_MATCHING_H_
