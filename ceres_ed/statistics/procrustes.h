// Generalised Procrustes alignment: takes position, rotation and size out of a population.
#ifndef CERES_ED_STATISTICS_PROCRUSTES_H_
#define CERES_ED_STATISTICS_PROCRUSTES_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/statistics/shape_table.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// What is taken out: position, rotation and size ("shape"), all but the size ("form"), or nothing.
enum class Alignment { kSimilarity, kRigid, kNone };

constexpr std::array<NamedValue<Alignment>, 3> NamesOf(Alignment) {
  return {{{"similarity", Alignment::kSimilarity},
           {"rigid", Alignment::kRigid},
           {"none", Alignment::kNone}}};
}

struct AlignedShapes {
  // mean_from_shape of each row.
  std::vector<Similarity> transforms;
  // The number of passes over the table.
  int rounds = 0;
};

// Aligns all shapes of `table` to their common mean (Gower 1975; Rohlf and Slice 1990; the partial
// form of Dryden and Mardia 2016): each shape is centred, scaled to unit centroid size unless the
// size is kept, and rotated to the mean of all, which is computed anew until it stands still. Then
// the mean gets the mean centroid size of the shapes, and is moved rigidly onto `frame` (3 V
// numbers, for example the template). Errors: a row could not be read, or its vertices are one
// point where a size is required.
StatusOr<AlignedShapes> AlignShapes(const ShapeTable& table,
                                    Alignment alignment,
                                    const Eigen::VectorXd& frame);

// Returns the shape (3 V numbers) after `transform`.
Eigen::VectorXd TransformShape(const Similarity& transform, const Eigen::VectorXd& shape);

}  // namespace ceres_ed

#endif  // CERES_ED_STATISTICS_PROCRUSTES_H_
