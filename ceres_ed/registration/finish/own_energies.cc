#include "ceres_ed/registration/finish/own_energies.h"

#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/util/describe_throw.h>

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

using RowMajorJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// One residual with its derivatives by the positions of its vertices.
struct Linearized {
  Eigen::VectorXd residual;
  std::vector<int> vertices;
  std::vector<RowMajorJacobian> jacobians;
};

// Evaluates `selected`. Returns false if this fails, or if the residual depends on an A_j.
bool Linearize(const SelectedResidual& selected,
               const ceres::CostFunction& cost,
               const DeformationState& state,
               Linearized* result) {
  std::vector<const double*> blocks;
  std::vector<RowMajorJacobian> full(selected.num_blocks);
  std::vector<double*> jacobians;
  result->residual.resize(cost.num_residuals());
  result->vertices.clear();
  for (int i = 0; i < selected.num_blocks; ++i) {
    blocks.push_back(BlockPointer(state, selected.blocks[i]));
    full[i].setZero(cost.num_residuals(), kNodeSize);
    jacobians.push_back(full[i].data());
    result->vertices.push_back(selected.blocks[i].node);
  }
  bool valid = false;
  const std::string thrown = DescribeThrow(
      [&] { valid = cost.Evaluate(blocks.data(), result->residual.data(), jacobians.data()); });
  if (!valid || !thrown.empty() || !result->residual.allFinite()) return false;
  result->jacobians.clear();
  for (const RowMajorJacobian& jacobian : full) {
    if (!jacobian.allFinite() || !jacobian.leftCols(kNodeTranslationOffset).isZero(0.0)) {
      return false;
    }
    result->jacobians.push_back(jacobian.rightCols(3));
  }
  return true;
}

// Does the same for a residual that has been evaluated with all others. Its point is the vertex to
// which it is bound.
bool LinearizeBatch(const SelectedResidual& selected,
                    const PointBatches& batches,
                    Linearized* result) {
  const int size = selected.num_residuals();
  result->residual =
      Eigen::Map<const Eigen::VectorXd>(batches.Residuals(selected.store, selected.index), size);
  result->jacobians = {Eigen::Map<const RowMajorJacobian>(
      batches.Jacobian(selected.store, selected.index), size, 3)};
  result->vertices = {selected.blocks[0].node};
  return result->residual.allFinite() && result->jacobians[0].allFinite();
}

}  // namespace

std::unique_ptr<OwnEnergies> OwnEnergies::Create(const UnitFit& fit, const WeldedMesh& mesh) {
  const std::vector<EnergySpec>& specs = fit.options->extra_energies;
  if (specs.empty() || !(fit.options->weights.data > 0.0)) return nullptr;
  const PointCloud& source = fit.source->cloud();
  std::unique_ptr<OwnEnergies> own(new OwnEnergies());
  for (const int point : mesh.point_of_vertex) own->graph_.AddNode(source.points[point]);
  const double whole = 1.0;
  for (const int v : mesh.vertex_of_point) own->skinning_.Add(&v, &whole, 1);
  own->state_.Resize(own->graph_.num_nodes());
  EnergyContext context;
  context.graph = &own->graph_;
  context.points = &source.points;
  if (source.HasNormals()) context.normals = &source.normals;
  if (source.HasTriangles()) context.triangles = &source.triangles;
  context.skinning = &own->skinning_;
  context.correspondences = &own->none_;
  context.landmarks = &fit.landmarks;
  own->builder_ = std::make_unique<ProblemBuilder>(own->graph_, /*has_camera=*/false);
  for (const EnergySpec& spec : specs) own->AddEnergy(fit, spec, context);
  own->builder_->Select(FullConfig(own->graph_.num_nodes(), /*has_camera=*/false),
                        &own->residuals_);
  if (own->residuals_.empty()) return nullptr;
  own->batches_.Build(own->graph_, own->residuals_);
  for (const SelectedResidual& residual : own->residuals_) {
    const bool is_batch = own->batches_.Residuals(residual.store, residual.index) != nullptr;
    own->costs_.push_back(is_batch ? nullptr : residual.CostFunction(own->graph_));
  }
  own->mesh_ = &mesh;
  if (!own->batches_.empty() && !mesh.triangles.empty()) {
    std::vector<Eigen::Vector3d> at_rest;
    for (const int point : mesh.point_of_vertex) at_rest.push_back(source.points[point]);
    own->normals_at_rest_ = WeldedNormals(mesh, at_rest);
  }
  own->weights_ = Eigen::VectorXd::Zero(own->graph_.num_nodes());
  return own;
}

void OwnEnergies::AddEnergy(const UnitFit& fit,
                            const EnergySpec& spec,
                            const EnergyContext& context) {
  StatusOr<std::unique_ptr<EnergyTerm>> energy = fit.registry->Create(spec.name, spec.parameters);
  if (!energy.ok()) return;
  const int term = builder_->AddTerm(spec.name, (*energy)->kind(), 1.0, spec.loss);
  builder_->CollectResiduals(term, **energy, context);
  // In the nodes' objective all pairs together have the weight w_data per squared unit of distance,
  // in the finish a vertex has about 1.
  const double unit = graph_.num_nodes() / (kPerSquaredLength * fit.options->weights.data);
  const TermRule rule = RuleOfUser((*energy)->kind());
  const int count = std::max(1, builder_->NumResidualBlocks(term));
  const double share = rule.scale == WeightScale::kPerResidual ? 1.0 / count : 1.0;
  builder_->SetWeight(term, spec.weight * rule.unit * share * unit);
  losses_.push_back(MakeLoss(spec.loss));
  energies_.push_back(*std::move(energy));
}

void OwnEnergies::TurnNormals(const std::vector<Eigen::Vector3d>& points) {
  if (normals_at_rest_.empty()) return;
  const std::vector<Eigen::Vector3d> normals = WeldedNormals(*mesh_, points);
  for (int v = 0; v < graph_.num_nodes(); ++v) {
    if (normals[v].isZero(0.0) || normals_at_rest_[v].isZero(0.0)) continue;
    MutableNodeAffine(state_.node(v)) =
        Eigen::Quaterniond::FromTwoVectors(normals_at_rest_[v], normals[v]).toRotationMatrix();
  }
}

const Eigen::VectorXd& OwnEnergies::Add(const std::vector<Eigen::Vector3d>& points,
                                        Eigen::MatrixXd* gradient) {
  for (int v = 0; v < graph_.num_nodes(); ++v) {
    MutableNodeTranslation(state_.node(v)) = points[v] - graph_.position(v);
  }
  bool batches_valid = true;
  if (!batches_.empty()) {
    TurnNormals(points);
    const std::string thrown = DescribeThrow([&] { batches_valid = batches_.Evaluate(state_); });
    batches_valid = batches_valid && thrown.empty();
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(graph_.num_nodes());
  Linearized linear;
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    if (costs_[i] == nullptr) {
      if (!batches_valid || !LinearizeBatch(residuals_[i], batches_, &linear)) continue;
    } else if (!Linearize(residuals_[i], *costs_[i], state_, &linear)) {
      continue;
    }
    double rho[3] = {0.0, 1.0, 0.0};
    const ceres::LossFunction* const loss = losses_[residuals_[i].term].get();
    if (loss != nullptr) loss->Evaluate(linear.residual.squaredNorm(), rho);
    const double weight = residuals_[i].weight * std::max(0.0, rho[1]);
    double sum = 0.0;
    for (const RowMajorJacobian& jacobian : linear.jacobians) sum += jacobian.norm();
    for (std::size_t k = 0; k < linear.vertices.size(); ++k) {
      const int v = linear.vertices[k];
      gradient->row(v) += weight * (linear.jacobians[k].transpose() * linear.residual).transpose();
      weights[v] += weight * linear.jacobians[k].norm() * sum;
    }
  }
  weights_ = weights_.cwiseMax(weights);
  return weights_;
}

}  // namespace ceres_ed
