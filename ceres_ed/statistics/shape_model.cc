#include "ceres_ed/statistics/shape_model.h"

#include <ceres_ed/statistics/gram_matrix.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace ceres_ed {
namespace {

// Subspace iteration ends when no variance changes by more than this share of the total.
constexpr double kTolerance = 1e-7;
constexpr int kMaxPasses = 16;
// So many more vectors than components are iterated: they make the last components converge.
constexpr int kOversampling = 8;

// Sets the mean and the variances of vertices.
Status MeasureSpread(const ShapeTable& table, ShapeModel* model) {
  StatusOr<Eigen::VectorXd> mean = MeanShape(table);
  if (!mean.ok()) return mean.status();
  model->mean = *std::move(mean);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(table.num_values());
  Eigen::VectorXd row(table.num_values());
  for (int i = 0; i < table.num_shapes(); ++i) {
    Status status = table.Read(i, 0, table.num_values(), row.data());
    if (!status.ok()) return status;
    squares += (row - model->mean).cwiseAbs2();
  }
  squares /= std::max(1, table.num_shapes() - 1);
  model->total_variance = squares.sum();
  model->vertex_variances.resize(table.num_vertices());
  for (int v = 0; v < table.num_vertices(); ++v) {
    model->vertex_variances[v] = squares.segment<3>(3 * v).sum();
  }
  return Status::Ok();
}

// Gives every component its sign.
void SetSigns(ShapeModel* model) {
  for (Eigen::Index k = 0; k < model->components.cols(); ++k) {
    Eigen::Index largest = 0;
    model->components.col(k).cwiseAbs().maxCoeff(&largest);
    if (model->components(largest, k) >= 0.0) continue;
    model->components.col(k) *= -1.0;
    model->scores.col(k) *= -1.0;
  }
}

// Returns how many components a population has at most.
int NumComponents(const ShapeTable& table, int max_components) {
  return std::max(0, std::min({max_components, table.num_shapes() - 1, table.num_values()}));
}

Status FitByGram(const ShapeTable& table, int count, ShapeModel* model) {
  const StatusOr<Eigen::MatrixXd> gram = GramMatrix(table, model->mean);
  if (!gram.ok()) return gram.status();
  const GramModes modes = DecomposeGram(CentredGram(*gram));
  const Eigen::Index kept = std::min<Eigen::Index>(count, modes.values.size());
  const Eigen::VectorXd lengths = modes.values.head(kept).cwiseSqrt();
  const Eigen::MatrixXd vectors = modes.vectors.leftCols(kept);
  model->variances = modes.values.head(kept) / std::max(1, table.num_shapes() - 1);
  model->scores = vectors * lengths.asDiagonal();
  // u_k = X^T v_k / sqrt(lambda_k).
  const Eigen::MatrixXd weights = vectors * lengths.cwiseInverse().asDiagonal();
  model->components.resize(table.num_values(), kept);
  return ForEachColumnBlock(table, [&](int first, ShapesInMemory::Matrix* block) {
    block->rowwise() -= model->mean.segment(first, block->cols()).transpose();
    model->components.middleRows(first, block->cols()).noalias() = block->transpose() * weights;
    return Status::Ok();
  });
}

// Sets `scores` = X Q and, unless it is null, `next` = X^T X Q.
Status Multiply(const ShapeTable& table,
                const Eigen::VectorXd& mean,
                const Eigen::MatrixXd& q,
                Eigen::MatrixXd* scores,
                Eigen::MatrixXd* next) {
  scores->resize(table.num_shapes(), q.cols());
  if (next != nullptr) next->setZero(q.rows(), q.cols());
  return ForEachRowBlock(table, [&](int first, ShapesInMemory::Matrix* block) {
    block->rowwise() -= mean.transpose();
    scores->middleRows(first, block->rows()).noalias() = *block * q;
    if (next != nullptr) {
      next->noalias() += block->transpose() * scores->middleRows(first, block->rows());
    }
    return Status::Ok();
  });
}

Eigen::MatrixXd Orthonormal(const Eigen::MatrixXd& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

Status FitByPasses(const ShapeTable& table, int count, ShapeModel* model) {
  const int width = std::min({count + kOversampling, table.num_shapes(), table.num_values()});
  Random random(1);
  Eigen::MatrixXd q(table.num_values(), width);
  for (Eigen::Index i = 0; i < q.size(); ++i) q.data()[i] = random.Gaussian();
  q = Orthonormal(q);
  const double degrees = std::max(1, table.num_shapes() - 1);
  Eigen::VectorXd variances = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd scores;
  Eigen::MatrixXd next;
  double change = 1.0;
  for (int pass = 0; pass < kMaxPasses && change > kTolerance; ++pass) {
    if (Status status = Multiply(table, model->mean, q, &scores, &next); !status.ok()) {
      return status;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(scores.transpose() * scores);
    const Eigen::VectorXd found = ritz.eigenvalues().reverse().head(count) / degrees;
    change = (found - variances).cwiseAbs().maxCoeff() / std::max(model->total_variance, 1e-300);
    variances = found;
    q = Orthonormal(next);
  }
  // The last subspace, turned to its principal axes.
  Status status = Multiply(table, model->mean, q, &scores, nullptr);
  if (!status.ok()) return status;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(scores.transpose() * scores);
  const Eigen::MatrixXd axes = ritz.eigenvectors().rowwise().reverse().leftCols(count);
  const Eigen::VectorXd values = ritz.eigenvalues().reverse().head(count).cwiseMax(0.0) / degrees;
  Eigen::Index kept = 0;
  while (kept < count && values[kept] > 1e-12 * model->total_variance) ++kept;
  model->variances = values.head(kept);
  model->components = q * axes.leftCols(kept);
  model->scores = scores * axes.leftCols(kept);
  return Status::Ok();
}

StatusOr<ShapeModel> FitModel(const ShapeTable& table, int max_components, bool by_gram) {
  ShapeModel model;
  if (Status status = MeasureSpread(table, &model); !status.ok()) return status;
  const int count = NumComponents(table, max_components);
  model.variances.resize(0);
  model.components.resize(table.num_values(), 0);
  model.scores.resize(table.num_shapes(), 0);
  if (count == 0 || !(model.total_variance > 0.0)) return model;
  Status status = by_gram ? FitByGram(table, count, &model) : FitByPasses(table, count, &model);
  if (!status.ok()) return status;
  SetSigns(&model);
  return model;
}

}  // namespace

Eigen::VectorXd ShapeModel::ExplainedShares() const {
  return variances / std::max(total_variance, 1e-300);
}

StatusOr<ShapeModel> FitShapeModel(const ShapeTable& table, int max_components) {
  return FitModel(table, max_components, table.num_shapes() <= kGramShapes);
}

StatusOr<ShapeModel> FitShapeModelByPasses(const ShapeTable& table, int max_components) {
  return FitModel(table, max_components, /*by_gram=*/false);
}

}  // namespace ceres_ed
