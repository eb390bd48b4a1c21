#include "ceres_ed/registration/intrinsic/functional_map.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>

namespace ceres_ed {
namespace {

// The normal equations of a functional map are damped by this share, for maps that reach few
// points.
constexpr double kDamping = 1e-6;

}  // namespace

Eigen::MatrixXd Rows(const Eigen::MatrixXd& matrix, const std::vector<int>& rows) {
  Eigen::MatrixXd taken(rows.size(), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) taken.row(i) = matrix.row(rows[i]);
  return taken;
}

Eigen::MatrixXd FunctionalMap(const SpectralPair& pair, const PointMap& map, int size) {
  const auto source = pair.source->functions.leftCols(size);
  const auto target = pair.target->functions.leftCols(size);
  Eigen::MatrixXd from(pair.source_rows.size() + pair.target_rows.size(), size);
  Eigen::MatrixXd to(from.rows(), size);
  from << Rows(source, pair.source_rows), Rows(source, map.back);
  to << Rows(target, map.forth), Rows(target, pair.target_rows);
  Eigen::MatrixXd normal = from.transpose() * from;
  normal.diagonal().array() += kDamping * normal.trace() / size;
  return normal.ldlt().solve(from.transpose() * to);
}

PointMap PointMapOf(const SpectralPair& pair, const Eigen::MatrixXd& map) {
  PointMap points =
      NearestRows(Rows(pair.source->functions.leftCols(map.rows()), pair.source_rows) * map,
                  Rows(pair.target->functions.leftCols(map.cols()), pair.target_rows));
  for (int& vertex : points.forth) vertex = pair.target_rows[vertex];
  for (int& vertex : points.back) vertex = pair.source_rows[vertex];
  return points;
}

PointMap ZoomOut(const SpectralPair& pair, PointMap map, int size, int last_size, int step) {
  for (; size <= std::min(last_size, pair.size()); size += step) {
    map = PointMapOf(pair, FunctionalMap(pair, map, size));
  }
  return map;
}

}  // namespace ceres_ed
