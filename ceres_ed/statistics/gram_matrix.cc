#include "ceres_ed/statistics/gram_matrix.h"

#include <numeric>

#include <Eigen/Eigenvalues>

namespace ceres_ed {
namespace {

// Some rows of another table.
class SomeShapes : public ShapeTable {
 public:
  SomeShapes(const ShapeTable& table, const std::vector<int>& shapes)
      : table_(table), shapes_(shapes) {}

  int num_shapes() const override { return static_cast<int>(shapes_.size()); }
  int num_vertices() const override { return table_.num_vertices(); }
  Status Read(int shape, int first, int count, double* values) const override {
    return table_.Read(shapes_[shape], first, count, values);
  }

 private:
  const ShapeTable& table_;
  const std::vector<int>& shapes_;
};

}  // namespace

StatusOr<Eigen::MatrixXd> GramMatrix(const ShapeTable& table,
                                     const Eigen::VectorXd& centre,
                                     const std::vector<int>& shapes) {
  std::vector<int> rows = shapes;
  if (rows.empty()) {
    rows.resize(table.num_shapes());
    std::iota(rows.begin(), rows.end(), 0);
  }
  const SomeShapes some(table, rows);
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(some.num_shapes(), some.num_shapes());
  Status status = ForEachColumnBlock(some, [&](int first, ShapesInMemory::Matrix* block) {
    block->rowwise() -= centre.segment(first, block->cols()).transpose();
    lower.selfadjointView<Eigen::Lower>().rankUpdate(*block);
    return Status::Ok();
  });
  if (!status.ok()) return status;
  Eigen::MatrixXd gram = lower.selfadjointView<Eigen::Lower>();
  return gram;
}

Eigen::MatrixXd CentredGram(const Eigen::MatrixXd& gram) {
  const Eigen::VectorXd means = gram.rowwise().mean();
  const double mean = means.mean();
  Eigen::MatrixXd centred = gram;
  centred.colwise() -= means;
  centred.rowwise() -= means.transpose();
  centred.array() += mean;
  return centred;
}

GramModes DecomposeGram(const Eigen::MatrixXd& centred_gram) {
  GramModes modes;
  if (centred_gram.rows() == 0) return modes;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred_gram);
  const double least = 1e-12 * centred_gram.trace();
  const Eigen::VectorXd values = solver.eigenvalues().reverse();
  Eigen::Index count = 0;
  while (count < values.size() && values[count] > least) ++count;
  modes.values = values.head(count);
  modes.vectors = solver.eigenvectors().rowwise().reverse().leftCols(count);
  return modes;
}

}  // namespace ceres_ed
