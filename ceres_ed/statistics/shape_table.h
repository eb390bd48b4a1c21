// A population of shapes with corresponding vertices, of which a part is in memory at a time.
#ifndef CERES_ED_STATISTICS_SHAPE_TABLE_H_
#define CERES_ED_STATISTICS_SHAPE_TABLE_H_

#include <ceres_ed/util/status.h>

#include <functional>
#include <utility>

#include <Eigen/Core>

namespace ceres_ed {

// N shapes with V vertices each: row i has x y z of all vertices of shape i, one after the other.
// Vertex v of every shape is the same place of the anatomy.
class ShapeTable {
 public:
  virtual ~ShapeTable() = default;

  virtual int num_shapes() const = 0;
  virtual int num_vertices() const = 0;

  // Copies `count` numbers of row `shape`, from number `first` on, to `values`. The error says what
  // could not be read.
  virtual Status Read(int shape, int first, int count, double* values) const = 0;

  int num_values() const { return 3 * num_vertices(); }
};

// A table in memory.
class ShapesInMemory : public ShapeTable {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // `rows` is N x 3 V.
  explicit ShapesInMemory(Matrix rows) : rows_(std::move(rows)) {}

  int num_shapes() const override { return static_cast<int>(rows_.rows()); }
  int num_vertices() const override { return static_cast<int>(rows_.cols() / 3); }
  Status Read(int shape, int first, int count, double* values) const override;

 private:
  Matrix rows_;
};

// Calls `use` for blocks of whole columns (N x W), from the left to the right, and returns its
// first error. W is a multiple of 3 and such that a block has at most `kBlockBytes`, but at
// least 3.
Status ForEachColumnBlock(
    const ShapeTable& table,
    const std::function<Status(int first_column, ShapesInMemory::Matrix* block)>& use);

// Does the same for blocks of whole rows (W x 3 V), from the top to the bottom; W is at least 1.
Status ForEachRowBlock(
    const ShapeTable& table,
    const std::function<Status(int first_row, ShapesInMemory::Matrix* block)>& use);

// The most that a block takes.
inline constexpr long kBlockBytes = 48L << 20;

// Returns the mean of all rows, 3 V numbers.
StatusOr<Eigen::VectorXd> MeanShape(const ShapeTable& table);

}  // namespace ceres_ed

#endif  // CERES_ED_STATISTICS_SHAPE_TABLE_H_
