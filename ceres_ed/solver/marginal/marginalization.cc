#include "ceres_ed/solver/marginal/marginalization.h"

#include <algorithm>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

using NodeVector = Eigen::Matrix<double, kNodeSize, 1>;

// The smallest damping, relative to the mean; it applies to parameters without curvature.
constexpr double kMinRelativeDiagonal = 1e-6;

// Returns the nodes of the residuals that are in `mask` (or that are not), in ascending order.
std::vector<int> NodesOf(const std::vector<SelectedResidual>& residuals,
                         const std::vector<char>& mask,
                         bool in_mask) {
  std::vector<char> touched(mask.size(), 0);
  for (const SelectedResidual& residual : residuals) {
    for (int i = 0; i < residual.num_blocks; ++i) touched[residual.blocks[i].node] = 1;
  }
  std::vector<int> nodes;
  for (int j = 0; j < static_cast<int>(mask.size()); ++j) {
    if (touched[j] != 0 && (mask[j] != 0) == in_mask) nodes.push_back(j);
  }
  return nodes;
}

Status CheckNoCamera(const ProblemBuilder& builder,
                     const std::vector<SelectedResidual>& residuals) {
  for (const SelectedResidual& residual : residuals) {
    for (int i = 0; i < residual.num_blocks; ++i) {
      if (residual.blocks[i].kind == BlockRef::Kind::kNode) continue;
      const std::string name =
          residual.term < 0 ? "a prior" : "energy '" + builder.label(residual.term) + "'";
      return Status::Error(name +
                           " joins a node without observations to the camera, so that it can't be "
                           "marginalised");
    }
  }
  return Status::Ok();
}

// Writes the parameters of some nodes one after the other, starting at `first_row`.
void AppendNodes(const DeformationState& state,
                 const std::vector<int>& nodes,
                 Eigen::Index first_row,
                 Eigen::VectorXd* rows) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    rows->segment<kNodeSize>(first_row + static_cast<Eigen::Index>(i) * kNodeSize) =
        Eigen::Map<const NodeVector>(state.node(nodes[i]));
  }
}

// Returns T T^T - shift I for a lower triangular T. It works on panels of columns, so that the
// zeros of T cost little time.
Eigen::MatrixXd UndoFactor(const Eigen::MatrixXd& T, double shift) {
  constexpr Eigen::Index kPanel = 48;
  const Eigen::Index n = T.rows();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; k += kPanel) {
    const Eigen::Index width = std::min(kPanel, n - k);
    product.bottomRightCorner(n - k, n - k)
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(T.block(k, k, n - k, width));
  }
  product.diagonal().array() -= shift;
  return product.selfadjointView<Eigen::Lower>();
}

}  // namespace

int Marginalization::num_eliminated_rows() const {
  return static_cast<int>(eliminated_.size()) * kNodeSize;
}

Status Marginalization::SetProblem(const ProblemBuilder& builder, const ProblemConfig& config) {
  equations_.reset();
  config_ = config;
  config_.camera_variable = false;
  config_.boundary_edges = BoundaryEdges::kKeep;
  const std::vector<SelectedResidual> residuals = builder.Select(config_);
  if (Status status = CheckNoCamera(builder, residuals); !status.ok()) return status;
  const std::vector<int> eliminated = NodesOf(residuals, config_.variable_nodes, true);
  const std::vector<int> boundary = NodesOf(residuals, config_.variable_nodes, false);
  const bool same_nodes = eliminated == eliminated_ && boundary == boundary_;
  eliminated_ = eliminated;
  boundary_ = boundary;
  std::vector<int> nodes = eliminated;
  nodes.insert(nodes.end(), boundary.begin(), boundary.end());
  equations_ = std::make_unique<NormalEquations>(builder, residuals, nodes);
  has_values_ = false;
  std::vector<Weighing> weighings = WeighingsOf(builder, residuals);
  has_factor_ = has_factor_ && weighings == weighings_;
  weighings_ = std::move(weighings);
  if (same_nodes && cholesky_ != nullptr && equations_->BlockPairs() == pairs_) {
    CHECK(equations_->SetStructure(structure_.get()));
  } else {
    UpdateStructure();
  }
  return Status::Ok();
}

bool Marginalization::Weighing::operator==(const Weighing& other) const {
  const bool same_loss = loss.type == other.loss.type &&
                         (loss.type == LossType::kSquared || loss.width == other.loss.width);
  return term == other.term && sum == other.sum && same_loss;
}

std::vector<Marginalization::Weighing> Marginalization::WeighingsOf(
    const ProblemBuilder& builder, const std::vector<SelectedResidual>& residuals) {
  std::vector<Weighing> weighings;
  for (const SelectedResidual& residual : residuals) {
    // The residuals are in the order of their terms.
    if (weighings.empty() || weighings.back().term != residual.term) {
      weighings.push_back(
          {residual.term, 0.0, residual.term < 0 ? LossSpec() : builder.loss(residual.term)});
    }
    weighings.back().sum += residual.weight;
  }
  return weighings;
}

void Marginalization::UpdateStructure() {
  has_factor_ = false;
  prior_.reset();
  pairs_ = equations_->BlockPairs();
  // The factor refers to the structure, so it is destroyed first.
  cholesky_.reset();
  structure_ = std::make_unique<BlockStructure>(equations_->BlockSizes(), pairs_);
  if (!eliminated_.empty()) {
    cholesky_ = std::make_unique<BlockCholesky>(*structure_, static_cast<int>(boundary_.size()));
  }
  CHECK(equations_->SetStructure(structure_.get()));
}

bool Marginalization::Linearize(const DeformationState& state, int num_threads) {
  CHECK(equations_ != nullptr) << "SetProblem comes first";
  has_factor_ = false;
  has_values_ = equations_->Evaluate(state, num_threads, &energy_, &values_, &gradient_);
  origin_.resize(structure_->num_rows());
  AppendNodes(state, eliminated_, 0, &origin_);
  AppendNodes(state, boundary_, num_eliminated_rows(), &origin_);
  return has_values_;
}

bool Marginalization::Eliminate(double damping) {
  CHECK(has_values_ && cholesky_ != nullptr) << "Linearize comes first, with nodes to eliminate";
  const int num_rows = num_eliminated_rows();
  Eigen::VectorXd diagonal = structure_->Diagonal(values_);
  // The Schur complement is only semi-definite, because a rigid motion of the boundary changes no
  // residual. With this shift on its diagonal it always has a factor, and the rounding error is not
  // larger than in the difference that defines the complement.
  shift_ = boundary_.empty()
               ? 0.0
               : std::max(diagonal.tail(diagonal.size() - num_rows).maxCoeff(), 1e-300);
  const double floor = std::max(kMinRelativeDiagonal * diagonal.head(num_rows).mean(), 1e-300);
  diagonal.head(num_rows) = damping * diagonal.head(num_rows).cwiseMax(floor);
  diagonal.tail(diagonal.size() - num_rows).setConstant(shift_);
  has_factor_ = cholesky_->Factorize(values_.data(), diagonal);
  if (!has_factor_) return false;
  damping_ = damping;
  ++num_eliminations_;
  is_fresh_ = true;
  factor_origin_ = origin_;
  boundary_factor_ = cholesky_->TrailingFactor();
  Quadratic quadratic;
  quadratic.hessian = UndoFactor(boundary_factor_, shift_);
  quadratic.origin = origin_.tail(origin_.size() - num_rows);
  quadratic.gradient = ReduceGradient(&quadratic.constant);
  if (prior_ == nullptr) {
    prior_ = std::make_unique<QuadraticCost>(std::vector<int>(boundary_.size(), kNodeSize),
                                             std::move(quadratic));
  } else {
    prior_->Set(std::move(quadratic));
  }
  return true;
}

// Eq. 20 for the right side. With L^-1 g = (y_f, y_s), g_f^T Lambda_ff^-1 g_f = |y_f|^2 and L_ss
// y_s = g_s - L_sf y_f.
Eigen::VectorXd Marginalization::ReduceGradient(double* constant) {
  reduced_gradient_ = cholesky_->SolveLower(gradient_);
  *constant = energy_ - 0.5 * reduced_gradient_.head(num_eliminated_rows()).squaredNorm();
  return boundary_factor_.triangularView<Eigen::Lower>() *
         reduced_gradient_.tail(boundary_factor_.rows());
}

bool Marginalization::Update(const DeformationState& state, int num_threads) {
  CHECK(equations_ != nullptr && has_factor_) << "SetProblem and Eliminate come first";
  double energy = 0.0;
  Eigen::VectorXd gradient;
  if (!equations_->EvaluateGradient(state, num_threads, &energy, &gradient)) return false;
  energy_ = energy;
  gradient_ = std::move(gradient);
  AppendNodes(state, eliminated_, 0, &origin_);
  AppendNodes(state, boundary_, num_eliminated_rows(), &origin_);
  is_fresh_ = false;
  has_values_ = false;
  double constant = 0.0;
  const Eigen::VectorXd reduced = ReduceGradient(&constant);
  prior_->SetOrigin(origin_.tail(boundary_factor_.rows()), reduced, constant);
  return true;
}

double Marginalization::LargestChange(const DeformationState& state) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < eliminated_.size(); ++i) {
    const NodeVector change =
        Eigen::Map<const NodeVector>(state.node(eliminated_[i])) -
        factor_origin_.segment<kNodeSize>(static_cast<Eigen::Index>(i) * kNodeSize);
    largest = std::max(largest, change.head<kNodeTranslationOffset>().lpNorm<Eigen::Infinity>());
  }
  return largest;
}

bool Marginalization::EvaluateEnergy(const DeformationState& state,
                                     int num_threads,
                                     double* energy) const {
  CHECK(equations_ != nullptr) << "SetProblem comes first";
  return equations_->EvaluateCost(state, num_threads, energy);
}

double Marginalization::LargestGradient() const {
  return gradient_.head(num_eliminated_rows()).lpNorm<Eigen::Infinity>();
}

ExtraResidual Marginalization::PriorResidual() const {
  ExtraResidual residual;
  residual.cost = prior_.get();
  for (const int node : boundary_) residual.blocks.push_back(BlockRef::Node(node));
  return residual;
}

Eigen::VectorXd Marginalization::BoundaryDifference(const DeformationState& state) const {
  Eigen::VectorXd boundary(boundary_factor_.rows());
  AppendNodes(state, boundary_, 0, &boundary);
  return boundary - origin_.tail(boundary.size());
}

double Marginalization::PriorValue(const DeformationState& state) const {
  return prior_->quadratic().Value(BoundaryDifference(state));
}

// Eq. 21 through the factor: L^T (x_f, d) = (-y_f, L_ss^T d). The boundary's part of the solution
// is d itself.
void Marginalization::BackSubstitute(DeformationState* state) const {
  CHECK(has_factor_) << "Eliminate comes first";
  Eigen::VectorXd rhs = -reduced_gradient_;
  rhs.tail(boundary_factor_.rows()) =
      boundary_factor_.triangularView<Eigen::Lower>().transpose() * BoundaryDifference(*state);
  const Eigen::VectorXd step = cholesky_->SolveUpper(rhs);
  for (std::size_t i = 0; i < eliminated_.size(); ++i) {
    const Eigen::Index row = static_cast<Eigen::Index>(i) * kNodeSize;
    Eigen::Map<NodeVector>(state->node(eliminated_[i])) =
        origin_.segment<kNodeSize>(row) + step.segment<kNodeSize>(row);
  }
}

}  // namespace ceres_ed
