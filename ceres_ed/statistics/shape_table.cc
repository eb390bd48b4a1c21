#include "ceres_ed/statistics/shape_table.h"

#include <algorithm>

namespace ceres_ed {
namespace {

constexpr long kNumberBytes = sizeof(double);

}  // namespace

Status ShapesInMemory::Read(int shape, int first, int count, double* values) const {
  const double* const row = rows_.data() + rows_.cols() * shape;
  std::copy(row + first, row + first + count, values);
  return Status::Ok();
}

Status ForEachColumnBlock(
    const ShapeTable& table,
    const std::function<Status(int first_column, ShapesInMemory::Matrix* block)>& use) {
  const long shapes = std::max(1, table.num_shapes());
  const long vertices = std::max(1L, kBlockBytes / (3 * kNumberBytes * shapes));
  const int width = static_cast<int>(std::min<long>(3 * vertices, table.num_values()));
  ShapesInMemory::Matrix block;
  for (int first = 0; first < table.num_values(); first += width) {
    const int count = std::min(width, table.num_values() - first);
    block.resize(table.num_shapes(), count);
    for (int i = 0; i < table.num_shapes(); ++i) {
      Status status = table.Read(i, first, count, block.row(i).data());
      if (!status.ok()) return status;
    }
    if (Status status = use(first, &block); !status.ok()) return status;
  }
  return Status::Ok();
}

Status ForEachRowBlock(
    const ShapeTable& table,
    const std::function<Status(int first_row, ShapesInMemory::Matrix* block)>& use) {
  const long row_bytes = kNumberBytes * std::max(1, table.num_values());
  const int height =
      static_cast<int>(std::min<long>(std::max(1L, kBlockBytes / row_bytes), table.num_shapes()));
  ShapesInMemory::Matrix block;
  for (int first = 0; first < table.num_shapes(); first += height) {
    const int count = std::min(height, table.num_shapes() - first);
    block.resize(count, table.num_values());
    for (int i = 0; i < count; ++i) {
      Status status = table.Read(first + i, 0, table.num_values(), block.row(i).data());
      if (!status.ok()) return status;
    }
    if (Status status = use(first, &block); !status.ok()) return status;
  }
  return Status::Ok();
}

StatusOr<Eigen::VectorXd> MeanShape(const ShapeTable& table) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(table.num_values());
  Eigen::VectorXd row(table.num_values());
  for (int i = 0; i < table.num_shapes(); ++i) {
    Status status = table.Read(i, 0, table.num_values(), row.data());
    if (!status.ok()) return status;
    sum += row;
  }
  sum /= std::max(1, table.num_shapes());
  return sum;
}

}  // namespace ceres_ed
