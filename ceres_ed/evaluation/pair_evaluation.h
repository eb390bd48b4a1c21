// How good a fit is: distances to the target, to the truth, and what the fit did to the mesh.
#ifndef CERES_ED_EVALUATION_PAIR_EVALUATION_H_
#define CERES_ED_EVALUATION_PAIR_EVALUATION_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Figures of a set of distances, all in the unit of the input. Percentiles are interpolated
// linearly between the sorted distances.
struct DistanceStatistics {
  double mean = 0.0;
  double rms = 0.0;
  double p50 = 0.0;
  double p95 = 0.0;
  double max = 0.0;
  // Mean of the smallest 80 %: what a part that is missing in the other surface does not spoil.
  double trimmed = 0.0;

  // Returns these in percent of `diagonal`; as they are where that is not positive.
  DistanceStatistics InPercentOf(double diagonal) const;
};

// Change of the edges and triangles between the source and the result.
struct ShapeChange {
  // Of |l' / l - 1| over all mesh edges (each point's six nearest neighbours on bare points), no
  // unit. Edges of length 0 in the source are left out.
  double edge_mean = 0.0;
  double edge_p95 = 0.0;
  double edge_p99 = 0.0;
  int edges = 0;
  // Triangles whose normal points against the source's after the mean of the best-fit rotations at
  // the three corners.
  int flipped = 0;
  // Triangles with less than 5 % of their area in the source.
  int degenerate = 0;
};

// Everything that Evaluate() measures. "Forward" is result to target, "backward" target to result.
struct Evaluation {
  // Diagonal of the target's bounding box, unit of the input: what percentages refer to.
  double diagonal = 0.0;
  // Vertices to the closest point of the other surface (to its points where it has no triangles).
  DistanceStatistics forward;
  DistanceStatistics backward;
  // Mean, p50, p95 and trimmed: the average of both ways; rms: the root of the average of both mean
  // squares; max: the larger one.
  DistanceStatistics symmetric;
  // Vertices to the nearest vertex of the other cloud.
  DistanceStatistics nearest_forward;
  DistanceStatistics nearest_backward;
  // Mean of |(r - q) . n| over result vertices r, with q the nearest target vertex and n its
  // normal (weighted by area on a mesh); nothing where the target has neither triangles nor
  // normals.
  std::optional<double> point_to_plane;
  // Mean angle between the normal of each result vertex and that of q, degrees (to [0, 90] where
  // one of them is known only up to sign); nothing unless both have normals or triangles.
  std::optional<double> normal_error_deg;
  // Distances of each vertex to its true place; with a truth only.
  std::optional<DistanceStatistics> truth;
  // With a source only.
  std::optional<ShapeChange> shape;
};

// Returns the statistics of `distances`; all zero for none.
DistanceStatistics Summarize(std::vector<double> distances);

// Returns for each of `points` its distance to the surface of `cloud` (not empty): to the
// triangles, and to vertices in no triangle. Exact.
std::vector<double> SurfaceDistances(const std::vector<Eigen::Vector3d>& points,
                                     const PointCloud& cloud);

// Returns for each vertex its distance to its counterpart. CHECKs that the sizes agree.
std::vector<double> PointDistances(const PointCloud& result, const PointCloud& truth);

// Returns what became of the edges and triangles of `source`. CHECKs that the sizes agree;
// triangles are the source's, or the result's where the source has none.
ShapeChange MeasureShapeChange(const PointCloud& source, const PointCloud& result);

// Returns every figure. `source` and `truth` may be null; their points are those of `result` in the
// same order. Errors: a cloud without points or with one that is not finite, unequal counts.
StatusOr<Evaluation> Evaluate(const PointCloud& result,
                              const PointCloud& target,
                              const PointCloud* source = nullptr,
                              const PointCloud* truth = nullptr);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_PAIR_EVALUATION_H_
