#include "ceres_ed/testing/cost_evaluation.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace ceres_ed {
namespace {

constexpr double kNotWritten = std::numeric_limits<double>::quiet_NaN();
// The number of doubles behind each array that must not be changed.
constexpr int kGuard = 16;
constexpr double kGuardValue = -7.25e77;

std::vector<double> GuardedArray(int size) {
  std::vector<double> values(size + kGuard, kGuardValue);
  std::fill_n(values.begin(), size, kNotWritten);
  return values;
}

bool IsGuardTouched(const std::vector<double>& values) {
  for (std::size_t i = values.size() - kGuard; i < values.size(); ++i) {
    if (values[i] != kGuardValue) return true;
  }
  return false;
}

std::vector<const double*> Pointers(const std::vector<std::vector<double>>& blocks) {
  std::vector<const double*> pointers;
  pointers.reserve(blocks.size());
  for (const std::vector<double>& block : blocks) pointers.push_back(block.data());
  return pointers;
}

template <typename Matrix>
bool SameBits(const Matrix& a, const Matrix& b) {
  return a.size() == b.size() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

CostEvaluation Evaluate(const ceres::CostFunction& cost,
                        const std::vector<std::vector<double>>& blocks,
                        const std::vector<char>* wanted) {
  const int num_residuals = cost.num_residuals();
  std::vector<double> residuals = GuardedArray(num_residuals);
  std::vector<std::vector<double>> arrays(blocks.size());
  std::vector<double*> jacobians(blocks.size(), nullptr);
  for (std::size_t b = 0; wanted != nullptr && b < blocks.size(); ++b) {
    if ((*wanted)[b] == 0) continue;
    arrays[b] = GuardedArray(num_residuals * static_cast<int>(blocks[b].size()));
    jacobians[b] = arrays[b].data();
  }
  CostEvaluation result;
  result.evaluated = cost.Evaluate(
      Pointers(blocks).data(), residuals.data(), wanted == nullptr ? nullptr : jacobians.data());
  result.residuals = Eigen::Map<Eigen::VectorXd>(residuals.data(), num_residuals);
  result.overrun = IsGuardTouched(residuals);
  result.jacobians.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (jacobians[b] == nullptr) continue;
    result.jacobians[b] = Eigen::Map<RowMajorMatrix>(
        jacobians[b], num_residuals, static_cast<Eigen::Index>(blocks[b].size()));
    result.overrun = result.overrun || IsGuardTouched(arrays[b]);
  }
  return result;
}

}  // namespace

bool CostEvaluation::IsFinite() const {
  if (!evaluated || !residuals.allFinite()) return false;
  for (const RowMajorMatrix& jacobian : jacobians) {
    if (!jacobian.allFinite()) return false;
  }
  return true;
}

CostEvaluation EvaluateCost(const ceres::CostFunction& cost,
                            const std::vector<std::vector<double>>& blocks,
                            const std::vector<char>& wanted) {
  return Evaluate(cost, blocks, &wanted);
}

CostEvaluation EvaluateResiduals(const ceres::CostFunction& cost,
                                 const std::vector<std::vector<double>>& blocks) {
  return Evaluate(cost, blocks, nullptr);
}

bool EqualToTheBit(const CostEvaluation& a, const CostEvaluation& b) {
  if (a.evaluated != b.evaluated || !SameBits(a.residuals, b.residuals)) return false;
  for (std::size_t i = 0; i < a.jacobians.size(); ++i) {
    if (a.jacobians[i].size() == 0 || b.jacobians[i].size() == 0) continue;
    if (!SameBits(a.jacobians[i], b.jacobians[i])) return false;
  }
  return true;
}

RowMajorMatrix NumericJacobian(const ceres::CostFunction& cost,
                               const std::vector<std::vector<double>>& blocks,
                               int block,
                               double step) {
  constexpr int kLevels = 8;
  constexpr double kShrink = 1.4;
  const int num_residuals = cost.num_residuals();
  RowMajorMatrix jacobian(num_residuals, static_cast<Eigen::Index>(blocks[block].size()));
  std::vector<std::vector<double>> moved = blocks;
  for (Eigen::Index column = 0; column < jacobian.cols(); ++column) {
    const double x = blocks[block][column];
    // Neville's table: row i has the difference of step i, extrapolated 0 to i times.
    std::array<std::array<Eigen::VectorXd, kLevels>, kLevels> table;
    Eigen::VectorXd error = Eigen::VectorXd::Constant(num_residuals, HUGE_VAL);
    double h = step;
    for (int i = 0; i < kLevels; ++i, h /= kShrink) {
      moved[block][column] = x + h;
      const CostEvaluation above = EvaluateResiduals(cost, moved);
      moved[block][column] = x - h;
      const CostEvaluation below = EvaluateResiduals(cost, moved);
      table[i][0] = (above.residuals - below.residuals) / (2.0 * h);
      if (!above.evaluated || !below.evaluated) table[i][0].setConstant(kNotWritten);
      if (i == 0) jacobian.col(column) = table[0][0];
      double factor = kShrink * kShrink;
      for (int j = 1; j <= i; ++j, factor *= kShrink * kShrink) {
        table[i][j] = (factor * table[i][j - 1] - table[i - 1][j - 1]) / (factor - 1.0);
        for (int r = 0; r < num_residuals; ++r) {
          const double new_error = std::max(std::abs(table[i][j][r] - table[i][j - 1][r]),
                                            std::abs(table[i][j][r] - table[i - 1][j - 1][r]));
          if (new_error > error[r]) continue;
          error[r] = new_error;
          jacobian(r, column) = table[i][j][r];
        }
      }
    }
    moved[block][column] = x;
  }
  return jacobian;
}

}  // namespace ceres_ed
