#include "ceres_ed/linear_algebra/block_cholesky.h"

#include <ceres_ed/linear_algebra/block_vertices.h>
#include <ceres_ed/linear_algebra/elimination_order.h>
#include <ceres_ed/linear_algebra/front_tree.h>
#include <ceres_ed/linear_algebra/multifrontal_factor.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// If a factorisation takes fewer multiplications than this, the search for a better order would
// take longer than the factorisation.
constexpr double kSmallFactor = 5e8;

double NumOperations(const std::vector<Front>& fronts) {
  double operations = 0.0;
  for (const Front& front : fronts) operations += FrontOperations(front.width, front.height);
  return operations;
}

// Orders the vertices and lays out the factor. Minimum degree is always tried; nested dissection is
// tried for large factors and kept if it needs fewer operations.
FactorLayout LayOut(const BlockStructure& structure,
                    const BlockVertices& vertices,
                    int num_trailing,
                    const std::function<bool()>& should_stop) {
  const std::vector<BlockPiece> pieces = vertices.Pieces(structure);
  const RowGraph graph = vertices.Graph(pieces);
  const auto fronts_by = [&](OrderingMethod method) {
    const std::vector<int> order =
        FillReducingOrder(graph, vertices.is_head(), num_trailing, method);
    return BuildFronts(graph, order, num_trailing);
  };
  std::vector<Front> fronts = fronts_by(OrderingMethod::kMinimumDegree);
  const bool stopped = should_stop && should_stop();
  if (HasNestedDissection() && NumOperations(fronts) > kSmallFactor && !stopped) {
    std::vector<Front> other = fronts_by(OrderingMethod::kNestedDissection);
    if (NumOperations(other) < NumOperations(fronts)) fronts = std::move(other);
  }
  return LayOutFactor(vertices, pieces, fronts);
}

}  // namespace

struct BlockCholesky::Impl {
  Impl(const BlockStructure& block_structure,
       int trailing,
       FactorMemory* memory,
       const std::function<bool()>& should_stop)
      : structure(block_structure),
        num_trailing_rows(structure.num_rows() -
                          structure.row_offset(structure.num_blocks() - trailing)),
        vertices(structure, trailing),
        factor(LayOut(structure, vertices, trailing, should_stop),
               memory != nullptr ? memory : &own_memory),
        ordered(structure.num_rows()) {}

  void ToOrdered(const Eigen::VectorXd& rows);
  Eigen::VectorXd FromOrdered() const;

  const BlockStructure& structure;
  const int num_trailing_rows;
  const BlockVertices vertices;
  FactorMemory own_memory;
  MultifrontalFactor factor;
  // A vector with its rows in the order of elimination: first the values that are added to the
  // diagonal, later the right side and its solution.
  Eigen::VectorXd ordered;
};

void BlockCholesky::Impl::ToOrdered(const Eigen::VectorXd& rows) {
  for (int v = 0; v < vertices.size(); ++v) {
    const BlockVertex& vertex = vertices[v];
    std::copy_n(rows.data() + structure.row_offset(vertex.block) + vertex.offset,
                vertex.size,
                ordered.data() + factor.layout().positions[v]);
  }
}

Eigen::VectorXd BlockCholesky::Impl::FromOrdered() const {
  Eigen::VectorXd rows(structure.num_rows());
  for (int v = 0; v < vertices.size(); ++v) {
    const BlockVertex& vertex = vertices[v];
    std::copy_n(ordered.data() + factor.layout().positions[v],
                vertex.size,
                rows.data() + structure.row_offset(vertex.block) + vertex.offset);
  }
  return rows;
}

BlockCholesky::BlockCholesky(const BlockStructure& structure,
                             int num_trailing,
                             FactorMemory* memory,
                             const std::function<bool()>& should_stop)
    : impl_(std::make_unique<Impl>(structure, num_trailing, memory, should_stop)) {}

BlockCholesky::~BlockCholesky() = default;

bool BlockCholesky::Factorize(const double* values,
                              const Eigen::VectorXd& diagonal,
                              int num_threads,
                              const std::function<bool()>& should_stop) {
  impl_->ToOrdered(diagonal);
  return impl_->factor.Factorize(values, impl_->ordered, num_threads, should_stop);
}

Eigen::VectorXd BlockCholesky::Solve(const Eigen::VectorXd& rhs) {
  impl_->ToOrdered(rhs);
  impl_->factor.SolveForward(&impl_->ordered);
  impl_->factor.ChangeSignOfDualRows(&impl_->ordered);
  impl_->factor.SolveBackward(&impl_->ordered);
  return impl_->FromOrdered();
}

Eigen::VectorXd BlockCholesky::SolveLower(const Eigen::VectorXd& rhs) {
  impl_->ToOrdered(rhs);
  impl_->factor.SolveForward(&impl_->ordered);
  return impl_->FromOrdered();
}

Eigen::VectorXd BlockCholesky::SolveUpper(const Eigen::VectorXd& rhs) {
  impl_->ToOrdered(rhs);
  impl_->factor.SolveBackward(&impl_->ordered);
  return impl_->FromOrdered();
}

Eigen::MatrixXd BlockCholesky::TrailingFactor() const {
  if (impl_->num_trailing_rows == 0) return {};
  Eigen::MatrixXd trailing = impl_->factor.LastTriangle();
  CHECK_EQ(trailing.rows(), impl_->num_trailing_rows);
  return trailing;
}

double BlockCholesky::LogDeterminant() const {
  CHECK_EQ(impl_->structure.num_dual(), 0);
  return impl_->factor.LogDeterminant();
}

SelectedInverse BlockCholesky::Invert() const {
  return SelectedInverse(impl_->structure, impl_->vertices, impl_->factor);
}

double BlockCholesky::NumOperations() const { return impl_->factor.layout().operations; }

std::size_t BlockCholesky::NumValues() const { return impl_->factor.layout().panel_size; }

}  // namespace ceres_ed
