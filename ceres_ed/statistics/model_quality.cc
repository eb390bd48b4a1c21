#include "ceres_ed/statistics/model_quality.h"

#include <ceres_ed/statistics/gram_matrix.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ceres_ed {
namespace {

// Returns at most `most` of the numbers 0, ..., count - 1, evenly chosen.
std::vector<int> EvenlyChosen(int count, int most) {
  std::vector<int> chosen;
  const int number = std::min(count, most);
  chosen.reserve(number);
  for (int i = 0; i < number; ++i) {
    chosen.push_back(static_cast<int>(static_cast<long>(i) * count / number));
  }
  return chosen;
}

// Returns the Gram matrix without row and column `left_out`.
Eigen::MatrixXd Without(const Eigen::MatrixXd& gram, int left_out) {
  const Eigen::Index n = gram.rows() - 1;
  const Eigen::Index after = n - left_out;
  Eigen::MatrixXd others(n, n);
  others.topLeftCorner(left_out, left_out) = gram.topLeftCorner(left_out, left_out);
  others.topRightCorner(left_out, after) = gram.topRightCorner(left_out, after);
  others.bottomLeftCorner(after, left_out) = gram.bottomLeftCorner(after, left_out);
  others.bottomRightCorner(after, after) = gram.bottomRightCorner(after, after);
  return others;
}

// Returns the squared distances of shape `left_out` from the models of all others with 1, 2, ...
// components. With y = x - mean and the modes (lambda, v) of the others' centred Gram matrix,
// u_k . y = v_k . g / sqrt(lambda_k), where g has the inner products of y with the centred others.
std::vector<double> LeaveOneOut(const Eigen::MatrixXd& gram, int left_out, int components) {
  const Eigen::MatrixXd others = Without(gram, left_out);
  Eigen::VectorXd with(others.rows());
  with << gram.col(left_out).head(left_out), gram.col(left_out).tail(others.rows() - left_out);
  const Eigen::VectorXd means = others.rowwise().mean();
  const Eigen::VectorXd g = (with - means).array() - (with - means).mean();
  double rest = gram(left_out, left_out) - 2.0 * with.mean() + means.mean();
  const GramModes modes = DecomposeGram(CentredGram(others));
  std::vector<double> distances;
  for (int k = 0; k < components; ++k) {
    if (k < modes.values.size()) {
      const double along = modes.vectors.col(k).dot(g);
      rest -= along * along / modes.values[k];
    }
    distances.push_back(std::max(0.0, rest));
  }
  return distances;
}

void MeasureGeneralization(const Eigen::MatrixXd& gram, int vertices, ModelQuality* quality) {
  const auto components = static_cast<int>(quality->generalization.size());
  const auto n = static_cast<int>(gram.rows());
  std::vector<double> squares(components, 0.0);
  for (int i = 0; i < n; ++i) {
    const std::vector<double> distances = LeaveOneOut(gram, i, components);
    for (int k = 0; k < components; ++k) {
      quality->generalization[k] += std::sqrt(distances[k] / vertices) / n;
      squares[k] += distances[k] / vertices / n;
    }
  }
  for (int k = 0; k < components; ++k) {
    const double mean = quality->generalization[k];
    quality->generalization_error[k] = std::sqrt(std::max(0.0, squares[k] - mean * mean) / (n - 1));
  }
}

// In the coordinates of the modes, where shape j is at c_j, a random shape with k components is at
// (b_1, ..., b_k, 0, ...), b_m normal with the variance of mode m.
void MeasureSpecificity(const Eigen::MatrixXd& gram,
                        int vertices,
                        const ModelQualityOptions& options,
                        ModelQuality* quality) {
  const GramModes modes = DecomposeGram(CentredGram(gram));
  const Eigen::MatrixXd places = modes.vectors * modes.values.cwiseSqrt().asDiagonal();
  const Eigen::VectorXd lengths = places.rowwise().squaredNorm();
  const auto components = static_cast<int>(quality->specificity.size());
  const int samples = std::max(1, options.samples);
  Random random(options.seed);
  for (int s = 0; s < samples; ++s) {
    Eigen::VectorXd distances = lengths;
    for (int k = 0; k < components; ++k) {
      const double normal = random.Gaussian();
      if (k < modes.values.size()) {
        const double b = normal * std::sqrt(modes.values[k] / static_cast<double>(gram.rows() - 1));
        distances.array() += b * b - 2.0 * b * places.col(k).array();
      }
      quality->specificity[k] +=
          std::sqrt(std::max(0.0, distances.minCoeff()) / vertices) / samples;
    }
  }
}

}  // namespace

StatusOr<ModelQuality> MeasureModelQuality(const ShapeTable& table,
                                           const ModelQualityOptions& options) {
  ModelQuality quality;
  if (table.num_shapes() < 3 || table.num_vertices() == 0) return quality;
  const std::vector<int> chosen = EvenlyChosen(table.num_shapes(), std::max(3, options.max_shapes));
  const StatusOr<Eigen::VectorXd> mean = MeanShape(table);
  if (!mean.ok()) return mean.status();
  const StatusOr<Eigen::MatrixXd> gram = GramMatrix(table, *mean, chosen);
  if (!gram.ok()) return gram.status();
  quality.shapes = static_cast<int>(chosen.size());
  // The model of all shapes but one has two components less than there are shapes.
  const int components = std::max(1, std::min(options.max_components, quality.shapes - 2));
  quality.generalization.assign(components, 0.0);
  quality.generalization_error.assign(components, 0.0);
  quality.specificity.assign(components, 0.0);
  MeasureGeneralization(*gram, table.num_vertices(), &quality);
  MeasureSpecificity(*gram, table.num_vertices(), options, &quality);
  return quality;
}

}  // namespace ceres_ed
