// The numeric part of a multifrontal Cholesky factorisation.
#ifndef CERES_ED_LINEAR_ALGEBRA_MULTIFRONTAL_FACTOR_H_
#define CERES_ED_LINEAR_ALGEBRA_MULTIFRONTAL_FACTOR_H_

#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/linear_algebra/front_layout.h>

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The factor L S L^T of a matrix that a FactorLayout describes, where S is -1 for dual rows and 1
// for the others. All vectors have their rows in the order of elimination.
class MultifrontalFactor {
 public:
  // `memory` must outlive this object and must not serve another factor at the same time.
  MultifrontalFactor(FactorLayout layout, FactorMemory* memory);

  const FactorLayout& layout() const { return layout_; }

  // Factorises the matrix with these `values` and `diagonal` added. Returns false if it is not
  // quasi-definite, or if `should_stop`, which is called by one thread at a time, returns true. The
  // result has the same bits at any number of threads.
  bool Factorize(const double* values,
                 const Eigen::VectorXd& diagonal,
                 int num_threads,
                 const std::function<bool()>& should_stop);

  // Replace `ordered` by L^-1 ordered, S ordered and L^-T ordered.
  void SolveForward(Eigen::VectorXd* ordered);
  void ChangeSignOfDualRows(Eigen::VectorXd* ordered) const;
  void SolveBackward(Eigen::VectorXd* ordered);

  // Returns log det of the matrix, which must have no dual rows.
  double LogDeterminant() const;

  // Returns the last front's own rows and columns of L, with zeros above the diagonal.
  Eigen::MatrixXd LastTriangle() const;

  // Return L11 (of which only the lower triangle is valid) and L21 of a front without dual columns.
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
  // Returns the panel of the columns that are not dual, from their first own row on.
  double* PrimalPanel(const FrontLayout& front) const {
    return Panel(front) + static_cast<std::ptrdiff_t>(front.dual_width) * front.panel_stride +
           front.own_row;
  }
  double* Update(const FrontLayout& front) const {
    return update_places_[&front - layout_.fronts.data()];
  }
  bool FactorizeInOrder(const double* values,
                        const Eigen::VectorXd& diagonal,
                        const std::function<bool()>& should_stop);
  void PlaceUpdate(int f, int thread);

  void TakeOwnRows(const FrontLayout& front, const Eigen::VectorXd& ordered);
  void PutOwnRows(const FrontLayout& front, Eigen::VectorXd* ordered) const;

  const FactorLayout layout_;
  // The panels, and the updates: with several threads first those that outlive their task, then one
  // stack per thread.
  FactorMemory* memory_;
  // The address of the update of each front.
  std::vector<double*> update_places_;
  // The rows of a front's panel while it is being solved.
  Eigen::VectorXd panel_rows_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_MULTIFRONTAL_FACTOR_H_
