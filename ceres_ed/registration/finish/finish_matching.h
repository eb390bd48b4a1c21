// Finds the pairs that attract the vertices in the finish: pairs with the target, in both
// directions.
#ifndef CERES_ED_REGISTRATION_FINISH_FINISH_MATCHING_H_
#define CERES_ED_REGISTRATION_FINISH_FINISH_MATCHING_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/registration/matching.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the moving surface (a blend of up to three vertices), and the plane that it should
// reach. The distance is mostly along `normal`.
struct FinishPair {
  std::array<int, 3> vertices = {-1, -1, -1};
  Eigen::Vector3d blend = Eigen::Vector3d::UnitX();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // The mean direction of the normals of the two surfaces.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double weight = 0.0;
};

// Finds the pairs of a finish, in each of its rounds.
class FinishMatcher {
 public:
  // All arguments must outlive this object. `fallback_normals`, one per vertex, are used if there
  // are no triangles.
  FinishMatcher(const Surface& source,
                const WeldedMesh& mesh,
                const std::vector<Eigen::Vector3d>& fallback_normals,
                const Surface& target,
                const MatchingOptions& options);

  // Returns the pairs of the vertices at `points`: each vertex with the closest point of the
  // target, and each target sample with the closest point of the moving surface. Pairs are accepted
  // by the rules of MatchBothWays(). Triangles of a curved surface lie within it; the targets are
  // moved by the distance between surface and triangle, which follows from the normals of the
  // corners. The weights are those of a Welsch loss whose width is `loss_width` robust standard
  // deviations of the distances across the surface. They sum to at most the number of vertices,
  // half of it for each direction. `points` must be the same vector at each call.
  // `should_stop` is called often; if it returns true, there are no pairs.
  std::vector<FinishPair> Match(const std::vector<Eigen::Vector3d>& points,
                                double loss_width,
                                const std::function<bool()>& should_stop = {});

  // Returns 1.4826 times the median distance across the surface over the last pairs.
  double robust_plane_distance() const { return robust_plane_distance_; }

 private:
  struct Candidate {
    FinishPair pair;
    double distance = 0.0;
    double plane = 0.0;
  };
  // Both add the pairs of one direction to `candidates`, and return false if they were stopped.
  bool MatchForward(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<Eigen::Vector3d>& normals,
                    const std::function<bool()>& should_stop,
                    std::vector<Candidate>* candidates);
  bool MatchBackward(const std::vector<Eigen::Vector3d>& points,
                     const std::vector<Eigen::Vector3d>& normals,
                     const std::function<bool()>& should_stop,
                     std::vector<Candidate>* candidates);
  // Returns the mean direction of two normals, or zero if they disagree.
  Eigen::Vector3d Between(const Eigen::Vector3d& moving, const Eigen::Vector3d& still) const;

  const Surface& source_;
  const WeldedMesh& mesh_;
  const std::vector<Eigen::Vector3d>& fallback_normals_;
  const Surface& target_;
  const MatchingOptions& options_;
  std::vector<int> target_samples_;
  // The closest places of the previous round: on the target for each vertex, and among the vertices
  // for each target sample; -1 if there was none.
  std::vector<int> on_target_;
  std::vector<int> nearest_vertex_;
  std::unique_ptr<KdTree> tree_;
  double robust_plane_distance_ = 0.0;
  double min_cosine_;
  bool oriented_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FINISH_MATCHING_H_
