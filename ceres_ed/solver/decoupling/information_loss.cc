#include "ceres_ed/solver/decoupling/information_loss.h"

#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// What is added to the diagonal, relative to it, and the least of it relative to the mean.
constexpr double kRegularization = 1e-10;
constexpr double kLeastRelativeDiagonal = 1e-6;

// The Gauss-Newton matrix of a problem, of which parts are factorised.
class Information {
 public:
  Status Evaluate(const ProblemBuilder& builder, const DeformationState& state, int num_threads) {
    const ProblemConfig config = FullConfig(builder.graph().num_nodes(), builder.has_camera());
    equations_.Build(builder, config);
    pairs_ = equations_.BlockPairs();
    sizes_ = equations_.BlockSizes();
    structure_ = std::make_unique<BlockStructure>(sizes_, pairs_);
    CHECK(equations_.SetStructure(structure_.get()));
    double cost = 0.0;
    Eigen::VectorXd gradient;
    if (!equations_.Evaluate(state, num_threads, &cost, &values_, &gradient)) {
      return Status::Error("a residual can't be evaluated, so the information is not known");
    }
    const Eigen::VectorXd diagonal = structure_->Diagonal(values_);
    const double floor =
        std::max(kLeastRelativeDiagonal * (diagonal.size() > 0 ? diagonal.mean() : 0.0), 1e-300);
    added_ = kRegularization * diagonal.cwiseMax(floor);
    return Status::Ok();
  }

  const NormalEquations& equations() const { return equations_; }
  int num_blocks() const { return static_cast<int>(sizes_.size()); }

  // Returns log det of the part of the matrix that belongs to some blocks.
  StatusOr<double> LogDeterminant(const std::vector<char>& blocks) const {
    std::vector<int> place(num_blocks(), -1);
    std::vector<int> kept;
    std::vector<int> sizes;
    for (int b = 0; b < num_blocks(); ++b) {
      if (blocks[b] == 0) continue;
      place[b] = static_cast<int>(kept.size());
      kept.push_back(b);
      sizes.push_back(sizes_[b]);
    }
    if (kept.empty()) return 0.0;
    std::vector<BlockPair> pairs;
    for (const BlockPair& pair : pairs_) {
      if (place[pair.row] < 0 || place[pair.column] < 0) continue;
      pairs.push_back({place[pair.row], place[pair.column], pair.head_pair});
    }
    const BlockStructure part(sizes, pairs);
    std::vector<double> values(part.num_values(), 0.0);
    Eigen::VectorXd added(part.num_rows());
    for (int c = 0; c < part.num_blocks(); ++c) {
      added.segment(part.row_offset(c), part.size(c)) =
          added_.segment(structure_->row_offset(kept[c]), part.size(c));
      for (int e = part.column_begin(c); e < part.column_begin(c + 1); ++e) {
        const int from = structure_->FindEntry(kept[part.entry_row(e)], kept[c]);
        const std::size_t size =
            static_cast<std::size_t>(part.size(part.entry_row(e))) * part.size(c);
        std::copy_n(values_.data() + structure_->value_offset(from),
                    size,
                    values.data() + part.value_offset(e));
      }
    }
    BlockCholesky cholesky(part);
    if (!cholesky.Factorize(values.data(), added)) {
      return Status::Error("the information matrix is not positive definite");
    }
    return cholesky.LogDeterminant();
  }

 private:
  NormalEquations equations_;
  std::vector<BlockPair> pairs_;
  std::vector<int> sizes_;
  std::unique_ptr<BlockStructure> structure_;
  std::vector<double> values_;
  Eigen::VectorXd added_;
};

}  // namespace

StatusOr<double> MeasureInformationLoss(const ProblemBuilder& builder,
                                        const std::vector<char>& observed,
                                        const std::vector<char>& moved,
                                        const DeformationState& state,
                                        int num_threads) {
  if (!builder.status().ok()) return builder.status();
  Information information;
  if (Status status = information.Evaluate(builder, state, num_threads); !status.ok()) {
    return status;
  }
  // The three kinds of blocks: observed (with the camera), moved PI, and held.
  enum { kObserved, kMoved, kHeld };
  std::vector<int> kinds(information.num_blocks(), kObserved);
  for (int i = 0; i < information.equations().num_variable_nodes(); ++i) {
    const int node = information.equations().variable_nodes()[i];
    if (observed[node] != 0) continue;
    kinds[i] = moved[node] != 0 ? kMoved : kHeld;
  }
  double sum = 0.0;
  const auto add = [&](double sign, bool with_observed, bool with_held) {
    std::vector<char> blocks;
    blocks.reserve(kinds.size());
    for (const int kind : kinds) {
      blocks.push_back(kind == kMoved || (kind == kObserved && with_observed) ||
                       (kind == kHeld && with_held));
    }
    const StatusOr<double> log_determinant = information.LogDeterminant(blocks);
    if (!log_determinant.ok()) return log_determinant.status();
    sum += sign * 0.5 * *log_determinant;
    return Status::Ok();
  };
  for (const Status& status : {add(1.0, true, false),
                               add(1.0, false, true),
                               add(-1.0, false, false),
                               add(-1.0, true, true)}) {
    if (!status.ok()) return status;
  }
  // Rounding may leave less than nothing.
  return std::max(0.0, sum);
}

}  // namespace ceres_ed
