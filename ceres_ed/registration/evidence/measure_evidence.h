// Measures how two fitted surfaces lie on each other, and how much the source was deformed.
#ifndef CERES_ED_REGISTRATION_EVIDENCE_MEASURE_EVIDENCE_H_
#define CERES_ED_REGISTRATION_EVIDENCE_MEASURE_EVIDENCE_H_

#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/evidence/fit_evidence.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A fit in the unit frame, in which the source has the diagonal 1. No pointer is null.
struct FittedSurfaces {
  // The source as it was placed, and its points and normals as they were fitted.
  const Surface* source = nullptr;
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
  const Surface* target = nullptr;
  const BuiltGraph* graph = nullptr;
  // The standard deviation of the target's noise, which widens what counts as matched.
  double noise = 0.0;
  int num_threads = 1;
};

// Fills in the figures of `evidence` that follow from the surfaces alone: source, target, residual,
// stretches and bends. Some thousand points of each surface are looked at. A point is matched if
// the other surface is within 1 % of the source's diagonal or three standard deviations of the
// noise (the larger), and if the normals differ by less than 60 degrees; it is unseen if its
// closest point lies on a border, or if the normals disagree and the other surface is open.
void MeasureEvidence(const FittedSurfaces& fit, FitEvidence* evidence);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_EVIDENCE_MEASURE_EVIDENCE_H_
