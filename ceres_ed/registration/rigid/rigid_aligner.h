// Robust ICP between two sampled surfaces, and how well a pose explains them.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_ALIGNER_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_ALIGNER_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/rigid/coarse_surface.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// What the aligner reads of one surface; refers to it.
struct RigidSide {
  const std::vector<Eigen::Vector3d>* points;
  // Unit length, or zero where none is known.
  const std::vector<Eigen::Vector3d>* normals;
  const std::vector<char>* is_border;
  const KdTree* tree;
  // The points that look for a partner.
  std::vector<int> samples;
};

// The side of a surface itself, with about `samples` of its points; `surface` must outlive it.
RigidSide MakeRigidSide(const Surface& surface, int samples);
RigidSide MakeRigidSide(const CoarseSurface& surface, int samples);

struct RigidAlignerOptions {
  bool with_scale = false;
  // Both surfaces have normals of known sign.
  bool oriented = true;
  // No pair whose normals differ by more, in (0, 180] degrees.
  double max_angle_deg = 60.0;
  // Distance at which a point counts half as missed, in the unit of the target, > 0.
  double width = 1.0;
  // What two samples of one surface are apart: as much of a distance along the surface is no miss,
  // in the unit of the target, >= 0.
  double slack = 0.0;
  int num_threads = 1;
};

// How much of each surface is missed, each in [0, 1].
struct RigidScore {
  double source_missed = 1.0;
  double target_missed = 1.0;

  // Of the surface that is explained better.
  double Better() const { return source_missed < target_missed ? source_missed : target_missed; }
  // Mostly of the surface that is explained better: of a partial target and a whole source most of
  // the source can't be explained.
  double Total() const;
};

class RigidAligner {
 public:
  RigidAligner(RigidSide source, RigidSide target, const RigidAlignerOptions& options);

  // The mean over the samples of each side of q / (1 + q), q = (distance / width)^2 + (angle
  // between the normals / 30 degrees)^2; 1 for a pair that is beyond max_angle_deg.
  RigidScore Score(const Similarity& pose) const;

  // The pose after at most `iterations` steps of point-to-plane ICP in both directions, by
  // Geman-McClure with the width annealed to the spread of the residuals.
  Similarity Refine(Similarity pose, int iterations) const;

 private:
  struct PlanePair;
  struct StepSums;
  using Vector7 = Eigen::Matrix<double, 7, 1>;

  // `nearest`, one a sample, has what was nearest at a pose before, or -1, and gets what is now.
  std::vector<PlanePair> Pairs(const Similarity& pose, std::vector<int>* nearest) const;
  bool Step(const std::vector<PlanePair>& pairs, double sigma, Similarity* pose) const;
  Vector7 SolveObserved(const StepSums& sums) const;

  RigidSide source_;
  RigidSide target_;
  RigidAlignerOptions options_;
  double min_cosine_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_ALIGNER_H_
