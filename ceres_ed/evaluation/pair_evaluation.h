// Measures how good a fit is: distances to the target and to the truth, and the change of the mesh.
#ifndef CERES_ED_EVALUATION_PAIR_EVALUATION_H_
#define CERES_ED_EVALUATION_PAIR_EVALUATION_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Statistics of a set of distances, all in the unit of the input. Percentiles are interpolated
// linearly between the sorted distances.
struct DistanceStatistics {
  double mean = 0.0;
  double rms = 0.0;
  double p50 = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
  // The mean of the smallest 80 %. It is not affected by a part that is missing in the other
  // surface.
  double trimmed = 0.0;

  // Returns the statistics in percent of `diagonal`, or unchanged if `diagonal` is not positive.
  DistanceStatistics InPercentOf(double diagonal) const;
};

// The change of edges and triangles between the source and the result.
struct ShapeChange {
  // The change |l' / l - 1| over all mesh edges (for bare points: the edges to the six nearest
  // neighbours of each point), without unit. Edges of length 0 in the source are left out.
  double edge_mean = 0.0;
  double edge_p95 = 0.0;
  double edge_p99 = 0.0;
  int edges = 0;
  // The number of triangles whose normal points against the normal in the source, after that has
  // been rotated by the mean of the best-fit rotations at the three corners.
  int flipped = 0;
  // The number of triangles with less than 5 % of their area in the source.
  int degenerate = 0;
};

// Everything that Evaluate() measures. "Forward" means from the result to the target, "backward"
// from the target to the result.
struct Evaluation {
  // The diagonal of the target's bounding box, in the unit of the input. Percentages refer to it.
  double diagonal = 0.0;
  // Distances of vertices to the closest point of the other surface (of its points, if it has no
  // triangles).
  DistanceStatistics forward;
  DistanceStatistics backward;
  // Both directions together. mean, p50, p95, p99 and trimmed are the averages of both directions;
  // rms is the root of the average of both mean squares; max is the larger maximum.
  DistanceStatistics symmetric;
  // Distances of vertices to the nearest vertex of the other cloud.
  DistanceStatistics nearest_forward;
  DistanceStatistics nearest_backward;
  // The mean of |(r - q) . n| over result vertices r, where q is the nearest target vertex and n
  // its normal (weighted by area on a mesh). Nothing if the target has neither triangles nor
  // normals.
  std::optional<double> point_to_plane;
  // The mean angle between the normals of each result vertex and of q, in degrees (folded to [0,
  // 90] if one of them is known only up to sign). Nothing unless both have normals or triangles.
  std::optional<double> normal_error_deg;
  // The distances of each vertex to its true position; only with a truth.
  std::optional<DistanceStatistics> truth;
  // The change of the mesh; only with a source.
  std::optional<ShapeChange> shape;
};

// Returns the statistics of `distances`; all are zero if there are none.
DistanceStatistics Summarize(std::vector<double> distances);

// Returns the exact distance of each point to the surface of `cloud`, which must not be empty. The
// surface is its triangles, and its vertices that belong to no triangle.
std::vector<double> SurfaceDistances(const std::vector<Eigen::Vector3d>& points,
                                     const PointCloud& cloud);

// Returns the distance of each vertex to the vertex with the same index. CHECKs that the sizes
// agree.
std::vector<double> PointDistances(const PointCloud& result, const PointCloud& truth);

// Returns the change of the edges and triangles of `source`. CHECKs that the sizes agree. The
// triangles are those of the source, or those of the result if the source has none.
ShapeChange MeasureShapeChange(const PointCloud& source, const PointCloud& result);

// Returns all measures. `source` and `truth` may be null; otherwise their points correspond to
// those of `result` in order. It is an error if a cloud has no points or a point that is not
// finite, or if counts differ.
StatusOr<Evaluation> Evaluate(const PointCloud& result,
                              const PointCloud& target,
                              const PointCloud* source = nullptr,
                              const PointCloud* truth = nullptr);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_PAIR_EVALUATION_H_
