// Robust ICP between two sampled surfaces, and a score of how well a pose explains them.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_ALIGNER_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_ALIGNER_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/rigid/coarse_surface.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The data of one surface that the aligner reads; it refers to the surface.
struct RigidSide {
  const std::vector<Eigen::Vector3d>* points;
  // Normals of unit length, or zero where none is known.
  const std::vector<Eigen::Vector3d>* normals;
  const std::vector<char>* is_border;
  const KdTree* tree;
  // The points for which partners are searched.
  std::vector<int> samples;
};

// Returns the side of a surface with about `samples` of its points; `surface` must outlive it.
RigidSide MakeRigidSide(const Surface& surface, int samples);
RigidSide MakeRigidSide(const CoarseSurface& surface, int samples);

// Options of RigidAligner.
struct RigidAlignerOptions {
  // Whether the scale is estimated, too; default false.
  bool with_scale = false;
  // Whether the sign of the normals of both surfaces is known; default true.
  bool oriented = true;
  // Whether the normals of the target are taken the other way round; default false.
  bool reversed = false;
  // The largest angle between the normals of a pair, in (0, 180] degrees; default 60.
  double max_angle_deg = 60.0;
  // The distance at which a point counts half as unmatched, in the unit of the target, > 0.
  double width = 1.0;
  // The spacing of the samples of a surface, in the unit of the target, >= 0: a distance along the
  // surface counts only as far as it exceeds this value.
  double slack = 0.0;
  int num_threads = 1;
};

// How much of each surface is not explained ("unmatched"), each in [0, 1].
struct RigidScore {
  double source_unmatched = 1.0;
  double target_unmatched = 1.0;

  // Returns the value of the surface that is explained better.
  double Better() const {
    return source_unmatched < target_unmatched ? source_unmatched : target_unmatched;
  }
  // Returns a mean in which the surface that is explained better has most of the weight: with a
  // partial target and a whole source, most of the source cannot be explained.
  double Total() const;
};

// Which directions of a step are taken.
enum class StepDirections {
  // Those that the pairs clearly determine.
  kDetermined,
  // All in which the pairs have any curvature, without point-to-point distances.
  kAll,
  // The same, and what sticks out is pulled in: where a border lies beyond the border of the other
  // surface, the two are laid on each other.
  kAllWithBorders,
};

// Aligns two surfaces and rates poses.
class RigidAligner {
 public:
  RigidAligner(RigidSide source, RigidSide target, const RigidAlignerOptions& options);

  // Returns the score of a pose: for each side the mean over its samples of q / (1 + q) with q =
  // (distance / width)^2 + (angle between the normals / 30 degrees)^2, and 1 for a pair beyond
  // max_angle_deg.
  RigidScore Score(const Similarity& pose) const;

  // Returns the pose after at most `iterations` steps of point-to-plane ICP in both directions,
  // with a Geman-McClure loss whose width is reduced with the spread of the residuals.
  Similarity Refine(Similarity pose,
                    int iterations,
                    StepDirections directions = StepDirections::kDetermined) const;

  // Returns the least curvature of the point-to-plane sum at a pose over all directions of motion
  // (turns are measured at the root mean square lever): the mean squared displacement across the
  // surface of a unit motion, in [0, 1]. It is near 0 for a surface that slides or turns at no
  // cost, and if there are too few pairs.
  double LeastCurvature(const Similarity& pose) const;

 private:
  struct PlanePair;
  struct StepSums;
  using Vector7 = Eigen::Matrix<double, 7, 1>;

  // Returns the pairs at a pose. `nearest` has, for each sample, the nearest point at an earlier
  // pose or -1, and receives the present one.
  std::vector<PlanePair> Pairs(const Similarity& pose, std::vector<int>* nearest) const;
  // Collects the normal equations of a step, with the share `point_share` of point-to-point
  // distances; `center` receives the mean of the moved points. Returns false if there are too few
  // pairs.
  bool Collect(const std::vector<PlanePair>& pairs,
               double sigma,
               double point_share,
               Eigen::Vector3d* center,
               StepSums* sums) const;
  void AddBorders(const std::vector<PlanePair>& pairs,
                  const Eigen::Vector3d& center,
                  StepSums* sums) const;
  bool Step(const std::vector<PlanePair>& pairs,
            double sigma,
            StepDirections directions,
            Similarity* pose) const;
  Vector7 SolveObserved(const StepSums& sums, StepDirections directions) const;

  RigidSide source_;
  RigidSide target_;
  RigidAlignerOptions options_;
  double min_cosine_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_ALIGNER_H_
