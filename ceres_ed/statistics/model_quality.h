// How good a model of shapes is: does it describe shapes that it has not seen, and only shapes?
#ifndef CERES_ED_STATISTICS_MODEL_QUALITY_H_
#define CERES_ED_STATISTICS_MODEL_QUALITY_H_

#include <ceres_ed/statistics/shape_table.h>
#include <ceres_ed/util/status.h>

#include <cstdint>
#include <vector>

namespace ceres_ed {

struct ModelQualityOptions {
  int max_components = 20;
  // The number of random shapes for the specificity.
  int samples = 1000;
  std::uint64_t seed = 1;
  // A larger population is measured on this many of its shapes, evenly chosen.
  int max_shapes = 200;
};

// Generalisation and specificity of Davies et al. (2002; Styner et al. 2003), for models of
// 1, 2, ... components. The distance of two shapes is the root mean square distance of their
// vertices, in the unit of the table.
struct ModelQuality {
  // The mean distance of a shape from its best description by the model of all other shapes.
  std::vector<double> generalization;
  // The standard error of that mean.
  std::vector<double> generalization_error;
  // The mean distance of a random shape of the model from the nearest shape of the population.
  std::vector<double> specificity;
  // The number of shapes that were measured.
  int shapes = 0;
};

// Returns the quality of the models of `table`, whose shapes must be aligned; empty lists for fewer
// than three shapes. Errors are those of the table.
StatusOr<ModelQuality> MeasureModelQuality(const ShapeTable& table,
                                           const ModelQualityOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_STATISTICS_MODEL_QUALITY_H_
