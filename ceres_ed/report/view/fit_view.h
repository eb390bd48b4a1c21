// What there is to see of a fit.
#ifndef CERES_ED_REPORT_VIEW_FIT_VIEW_H_
#define CERES_ED_REPORT_VIEW_FIT_VIEW_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/report/view/scene.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A landmark as it was given.
struct GivenLandmark {
  std::string name;
  Landmark landmark;
};

// The parts of a fit. What is null or empty is not shown.
struct FitParts {
  // The source where it was given. Null if it is not known: then only the result is shown.
  const PointCloud* source = nullptr;
  const PointCloud* target = nullptr;
  // The points of the result, with the points of the source in their order, and its triangles.
  const std::vector<Eigen::Vector3d>* result = nullptr;
  const std::vector<std::array<int, 3>>* triangles = nullptr;
  // The true place of each point.
  const std::vector<Eigen::Vector3d>* truth = nullptr;
  // The deformation, and the binding of the source's points to its nodes.
  const Warp* warp = nullptr;
  const Skinning* skinning = nullptr;
  // 1 for nodes that data reach; null if it is not known.
  const std::vector<char>* point_relevant = nullptr;
  // target_from_source, if it is known without a warp.
  const Similarity* rigid = nullptr;
  // The standard deviation of each point; NaN or negative where it is unknown.
  std::vector<double> std_dev;
  std::vector<GivenLandmark> landmarks;
  // The rows of the source's points in its file; empty if these are the indices.
  std::vector<int> rows;
  int max_points = kMaxViewPoints;
};

// Distances of all points, not only of those that are shown, in the unit of the target. Each is
// empty if it is not known.
struct FitDistances {
  // From the points of the result to the target, and from those of the target to the result.
  std::vector<double> to_target;
  std::vector<double> from_target;
  // From the points of the rigidly placed source to the target.
  std::vector<double> rigid_to_target;
  // From the points of the result, and of the rigidly placed source, to their true places.
  std::vector<double> to_truth;
  std::vector<double> rigid_to_truth;
};

struct FitView {
  Scene scene;
  FitDistances distances;
};

// Returns what there is to see. Surface 0 is the source on its way to the result, or the result if
// there is no source; the next one is the target. The fields have the keys `distance` (of source
// and target), `truth`, `stretch`, `std_dev`, `bend` and `displacement`, as far as they are known.
// If the warp does not reach the result (another run has written it), the points move along
// straight lines, and a note says so. Points of the parts must be finite, and as many as the
// docstrings say.
FitView MakeFitView(const FitParts& parts);

// Returns for each point the mean of l' / l - 1 in percent over its edges, where l and l' are the
// lengths before and after; NaN for a point without edges of a positive length.
std::vector<double> MeanEdgeStretch(const std::vector<Eigen::Vector3d>& before,
                                    const std::vector<Eigen::Vector3d>& after,
                                    const std::vector<std::array<int, 3>>& triangles);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_FIT_VIEW_H_
