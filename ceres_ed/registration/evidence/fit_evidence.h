// What a fit shows about its own quality, without knowing the truth.
#ifndef CERES_ED_REGISTRATION_EVIDENCE_FIT_EVIDENCE_H_
#define CERES_ED_REGISTRATION_EVIDENCE_FIT_EVIDENCE_H_

namespace ceres_ed {

// How one surface lies on the other one after the fit. The three shares are parts of its area, and
// their sum is 1.
struct CoverEvidence {
  // The part that lies on the other surface, with normals that agree.
  double matched = 0.0;
  // The part that does not, although the other surface shows this place.
  double missed = 0.0;
  // The part of which the other surface shows nothing: beyond its border, or on its far side.
  double unseen = 1.0;

  // Returns the unmatched part of what could be seen, in [0, 1].
  double Unmatched() const { return matched + missed > 0.0 ? missed / (matched + missed) : 1.0; }
};

// Lengths are fractions of the diagonal of the rigidly placed source. A figure is -1 where it was
// not measured.
struct FitEvidence {
  // Whether there was a target to measure.
  bool measured = false;
  CoverEvidence source;
  CoverEvidence target;
  // The root mean square distance across the surface, over the matched parts of both surfaces.
  double residual = -1.0;
  // The standard deviation of the target's noise across its surface.
  double noise = 0.0;
  // The 95th percentile of the change of length |log(after / before)|: over the edges of the mesh
  // (for bare points, the links to their nearest points), and over the edges of the graph.
  double edge_stretch = -1.0;
  double node_stretch = -1.0;
  // The share of the faces that are folded over or squeezed flat.
  double folded = 0.0;
  // The mean distance of the fitted points from the best rigid motion of the source, over all
  // points and over those that are matched.
  double bend = 0.0;
  double bend_matched = 0.0;
  // How well the shape around the matched parts keeps points from sliding along the surface: the
  // mean over patches with a radius of a tenth of the diagonal of sqrt(l1 l2), where l1 <= l2 are
  // the two smaller eigenvalues of the mean of n n' over the normals n of the patch. It is 0 on a
  // plane, below 0.1 on smooth round bodies, and about 0.2 on bodies with limbs.
  double relief = -1.0;
  // What the rigid placement leaves unmatched, in [0, 1]; and the least that any pose which differs
  // from it leaves, as a multiple of what it leaves itself (-1: no such pose was tried). Both are
  // compared on coarse surfaces.
  double rigid_score = -1.0;
  double rigid_runner_up = -1.0;
  // The least curvature of the rigid objective over all directions of motion, as a share of what a
  // direction across the surface has; in [0, 1]. A body that slides or turns at no cost has 0.
  double rigid_curvature = -1.0;
  // The mean distance between the ends of the two ways on the coarse graphs that leave the least
  // unexplained (hypotheses/hypothesis.h); -1 if only one was tried.
  double disagreement = -1.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_EVIDENCE_FIT_EVIDENCE_H_
