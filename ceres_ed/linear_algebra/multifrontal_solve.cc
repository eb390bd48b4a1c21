// Solves linear systems with a multifrontal factor, front by front.
#include <ceres_ed/linear_algebra/front_kernels.h>
#include <ceres_ed/linear_algebra/multifrontal_factor.h>

#include <algorithm>

namespace ceres_ed {
namespace {

// Solves L11 x = x for the first `width` of `num_rows` rows, and subtracts L21 x from the rows
// below.
void SolvePanel(int width, int num_rows, int stride, const double* panel, double* x) {
  for (int c = 0; c < width; ++c) {
    const double* column = panel + static_cast<std::ptrdiff_t>(c) * stride;
    x[c] /= column[c];
    for (int r = c + 1; r < width; ++r) x[r] -= column[r] * x[c];
  }
  const int below = RoundUpRows(width);
  SubtractProduct(width, num_rows - below, panel + below, stride, x, x + below);
}

// Solves L11^T x = x - L21^T x_below for the first `width` rows, where x_below are the rows below.
void SolveTransposedPanel(int width, int num_rows, int stride, const double* panel, double* x) {
  const int below = RoundUpRows(width);
  SubtractTransposedProduct(width, num_rows - below, panel + below, stride, x + below, x);
  for (int c = width - 1; c >= 0; --c) {
    const double* column = panel + static_cast<std::ptrdiff_t>(c) * stride;
    double sum = x[c];
    for (int r = c + 1; r < width; ++r) sum -= column[r] * x[r];
    x[c] = sum / column[c];
  }
}

}  // namespace

// Copies a front's own rows from `ordered` to the rows of its panel.
void MultifrontalFactor::TakeOwnRows(const FrontLayout& front, const Eigen::VectorXd& ordered) {
  const double* own = ordered.data() + front.first_position;
  panel_rows_.head(front.below_row).setZero();
  std::copy_n(own, front.dual_width, panel_rows_.data());
  std::copy_n(
      own + front.dual_width, front.width - front.dual_width, panel_rows_.data() + front.own_row);
}

void MultifrontalFactor::PutOwnRows(const FrontLayout& front, Eigen::VectorXd* ordered) const {
  double* own = ordered->data() + front.first_position;
  std::copy_n(panel_rows_.data(), front.dual_width, own);
  std::copy_n(
      panel_rows_.data() + front.own_row, front.width - front.dual_width, own + front.dual_width);
}

void MultifrontalFactor::SolveForward(Eigen::VectorXd* ordered) {
  for (const FrontLayout& front : layout_.fronts) {
    TakeOwnRows(front, *ordered);
    panel_rows_.segment(front.below_row, front.padded_update_rows).setZero();
    if (front.dual_width > 0) {
      SolvePanel(front.dual_width,
                 front.panel_rows(),
                 front.panel_stride,
                 Panel(front),
                 panel_rows_.data());
    }
    SolvePanel(front.width - front.dual_width,
               front.panel_rows() - front.own_row,
               front.panel_stride,
               PrimalPanel(front),
               panel_rows_.data() + front.own_row);
    PutOwnRows(front, ordered);
    const double* below = panel_rows_.data() + front.below_row;
    for (const RowRun& run : front.below) {
      for (int i = 0; i < run.length; ++i) (*ordered)[run.to + i] += below[run.from + i];
    }
  }
}

void MultifrontalFactor::ChangeSignOfDualRows(Eigen::VectorXd* ordered) const {
  for (const FrontLayout& front : layout_.fronts) {
    ordered->segment(front.first_position, front.dual_width) *= -1.0;
  }
}

void MultifrontalFactor::SolveBackward(Eigen::VectorXd* ordered) {
  for (auto front = layout_.fronts.rbegin(); front != layout_.fronts.rend(); ++front) {
    TakeOwnRows(*front, *ordered);
    double* below = panel_rows_.data() + front->below_row;
    std::fill_n(below, front->padded_update_rows, 0.0);
    for (const RowRun& run : front->below) {
      for (int i = 0; i < run.length; ++i) below[run.from + i] = (*ordered)[run.to + i];
    }
    SolveTransposedPanel(front->width - front->dual_width,
                         front->panel_rows() - front->own_row,
                         front->panel_stride,
                         PrimalPanel(*front),
                         panel_rows_.data() + front->own_row);
    if (front->dual_width > 0) {
      SolveTransposedPanel(front->dual_width,
                           front->panel_rows(),
                           front->panel_stride,
                           Panel(*front),
                           panel_rows_.data());
    }
    PutOwnRows(*front, ordered);
  }
}

double MultifrontalFactor::LogDeterminant() const {
  double sum = 0.0;
  for (const FrontLayout& front : layout_.fronts) {
    sum += 2.0 * OwnColumns(front).diagonal().array().log().sum();
  }
  return sum;
}

Eigen::MatrixXd MultifrontalFactor::LastTriangle() const {
  const FrontLayout& front = layout_.fronts.back();
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(front.width, front.width);
  for (int c = 0; c < front.width; ++c) {
    const double* column = Panel(front) + static_cast<std::ptrdiff_t>(c) * front.panel_stride;
    std::copy(column + c, column + front.width, &triangle(c, c));
  }
  return triangle;
}

}  // namespace ceres_ed
