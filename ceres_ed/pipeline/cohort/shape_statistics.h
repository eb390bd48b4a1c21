// The statistics of the shapes of a cohort, and their files.
#ifndef CERES_ED_PIPELINE_COHORT_SHAPE_STATISTICS_H_
#define CERES_ED_PIPELINE_COHORT_SHAPE_STATISTICS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/pipeline/cohort/cohort_settings.h>
#include <ceres_ed/pipeline/cohort/collected_member.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

struct ShapeStatistics {
  // What statistics.json has; null if no shape takes part.
  nlohmann::ordered_json report;
  // The mean, with the triangles of the template.
  PointCloud mean;
  // The root mean square distance of the mean from the template, as a fraction of the template's
  // diagonal.
  double change = 0.0;
  std::vector<std::string> notes;
};

// Returns the cloud of OUTPUT/template.ply, which has the points of the template that fits use.
StatusOr<PointCloud> ReadCohortTemplate(const std::string& folder);

// Sets in_model of the members that take part: those that are done, with a verdict at least as good
// as `settings.worst`, and as many points as the template. Reads their points, one shape at a time,
// and writes in `output`:
//   rows.csv             `row,name,group` of the arrays
//   correspondences.npy  N x V x 3: the points of the template on each shape, where the shape lies
//   aligned.npy          the same after the alignment
//   mean.ply             the mean, with std_dev, the root of the variance of each vertex
//   components.npy       K x V x 3, and component_NN_plus.ply and _minus.ply: mean +- 2 standard
//                        deviations of the first ones
//   scores.csv           the coefficients of each shape
//   groups.ply           the test of groups, if there are at least two
//   statistics.json      variances, generalisation, specificity
// Errors are about files that can't be read or written.
StatusOr<ShapeStatistics> ComputeShapeStatistics(const std::string& output,
                                                 const ModelSettings& settings,
                                                 const PointCloud& source,
                                                 CollectedMembers* all);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_SHAPE_STATISTICS_H_
