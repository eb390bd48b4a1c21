#include "ceres_ed/registration/intrinsic/wave_kernel.h"

#include <algorithm>
#include <cmath>

namespace ceres_ed {

Eigen::MatrixXd WaveKernelSignature(const SpectralBasis& basis,
                                    double first,
                                    double last,
                                    int count) {
  constexpr double kWidthInSteps = 4.0;
  const double step = (std::log(last) - std::log(first)) / (count - 1);
  const double sigma = kWidthInSteps * step;
  // The constant function says nothing about a point.
  const int waves = basis.size() - 1;
  Eigen::MatrixXd weights(waves, count);
  for (int e = 0; e < count; ++e) {
    const double energy = std::log(first) + e * step;
    for (int k = 0; k < waves; ++k) {
      const double apart = energy - std::log(std::max(basis.eigenvalues[k + 1], 1e-6 * first));
      weights(k, e) = std::exp(-apart * apart / (2.0 * sigma * sigma));
    }
    weights.col(e) /= std::max(weights.col(e).sum(), 1e-300);
  }
  return basis.functions.rightCols(waves).cwiseAbs2() * weights;
}

void ScaleSignatures(Eigen::MatrixXd* first, Eigen::MatrixXd* second) {
  const Eigen::RowVectorXd mean = first->colwise().mean();
  const Eigen::RowVectorXd deviation =
      (first->rowwise() - mean).cwiseAbs2().colwise().mean().cwiseSqrt();
  const Eigen::RowVectorXd scale = deviation.cwiseMax(1e-12).cwiseInverse();
  *first = *first * scale.asDiagonal();
  *second = *second * scale.asDiagonal();
}

}  // namespace ceres_ed
