// The numeric part of a multifrontal Cholesky factorisation.
#ifndef CERES_ED_LINEAR_ALGEBRA_MULTIFRONTAL_FACTOR_H_
#define CERES_ED_LINEAR_ALGEBRA_MULTIFRONTAL_FACTOR_H_

#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/linear_algebra/front_layout.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// L S L^T of a matrix that a FactorLayout describes, S = -1 for dual rows and 1 for the others. All
// vectors have their rows in the order of elimination.
class MultifrontalFactor {
 public:
  // `memory` outlives this and serves no other factor meanwhile.
  MultifrontalFactor(FactorLayout layout, FactorMemory* memory);

  const FactorLayout& layout() const { return layout_; }

  // Of the matrix of `values` with `diagonal` added. False when it isn't quasi-definite. The same
  // bits at any number of threads.
  bool Factorize(const double* values, const Eigen::VectorXd& diagonal, int num_threads);

  // L^-1, S and L^-T.
  void SolveForward(Eigen::VectorXd* ordered);
  void ChangeSignOfDualRows(Eigen::VectorXd* ordered) const;
  void SolveBackward(Eigen::VectorXd* ordered);

  // The last front's own rows and columns of L; zeros above the diagonal.
  Eigen::MatrixXd LastTriangle() const;

  // L11 (of which the lower triangle counts) and L21 of a front without dual columns.
  using PanelView = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  PanelView OwnColumns(const FrontLayout& front) const {
    return {Panel(front), front.width, front.width, Eigen::OuterStride<>(front.panel_stride)};
  }
  PanelView Below(const FrontLayout& front) const {
    return {Panel(front) + front.below_row,
            front.update_rows,
            front.width,
            Eigen::OuterStride<>(front.panel_stride)};
  }

 private:
  bool FactorizeFront(int f,
                      const double* values,
                      const Eigen::VectorXd& diagonal,
                      int num_threads);
  void TakePieces(const FrontLayout& front, const double* values, const Eigen::VectorXd& diagonal);
  void TakeColumns(const FrontLayout& front, const FrontLayout& child);
  void TakeUpdate(const FrontLayout& front, const FrontLayout& child);
  bool FactorizeOwnColumns(const FrontLayout& front);
  void MakeUpdate(const FrontLayout& front, int num_threads);

  double* Panel(const FrontLayout& front) const { return memory_->panels.data() + front.panel; }
  // Of the columns that aren't dual, from their first row on.
  double* PrimalPanel(const FrontLayout& front) const {
    return Panel(front) + static_cast<std::ptrdiff_t>(front.dual_width) * front.panel_stride +
           front.own_row;
  }
  double* Update(const FrontLayout& front) const {
    return update_places_[&front - layout_.fronts.data()];
  }
  void PlaceUpdate(int f, int thread);

  void TakeOwnRows(const FrontLayout& front, const Eigen::VectorXd& ordered);
  void PutOwnRows(const FrontLayout& front, Eigen::VectorXd* ordered) const;

  const FactorLayout layout_;
  // Panels, and updates: those that outlive their task, then a stack of each thread.
  FactorMemory* memory_;
  // Of each front: where its update is.
  std::vector<double*> update_places_;
  // Rows of a front's panel, while it is solved for.
  Eigen::VectorXd panel_rows_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_MULTIFRONTAL_FACTOR_H_
