#include "ceres_ed/solver/covariance/state_covariance.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/linear_algebra/regularized_inverse.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include <ceres/manifold.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

constexpr int kCameraSize = 6;

// Returns the pairs of blocks to which a common point is bound.
std::vector<BlockPair> PairsOf(const Skinning& skinning, const std::vector<int>& block_of_node) {
  std::set<std::pair<int, int>> pairs;
  for (std::size_t p = 0; p < skinning.size(); ++p) {
    const Binding binding = skinning[p];
    for (int a = 0; a < binding.size; ++a) {
      for (int b = 0; b < a; ++b) {
        const int i = block_of_node[binding.nodes[a]];
        const int j = block_of_node[binding.nodes[b]];
        if (i >= 0 && j >= 0) pairs.emplace(std::max(i, j), std::min(i, j));
      }
    }
  }
  std::vector<BlockPair> result;
  result.reserve(pairs.size());
  for (const auto& [row, column] : pairs) result.push_back({row, column, true});
  return result;
}

Eigen::MatrixXd NotANumber(int rows) {
  return Eigen::MatrixXd::Constant(rows, rows, std::numeric_limits<double>::quiet_NaN());
}

// Returns d(R p + T) / d(rotation, translation) with `rotated` = R p. The tangent space is that of
// q' = [sin |d| d / |d|, cos |d|] q, which is a rotation by 2 |d|.
Eigen::MatrixXd CameraDerivative(const Eigen::Vector3d& rotated) {
  Eigen::MatrixXd J(3, kCameraSize);
  J << 0.0, 2.0 * rotated.z(), -2.0 * rotated.y(), 1.0, 0.0, 0.0, -2.0 * rotated.z(), 0.0,
      2.0 * rotated.x(), 0.0, 1.0, 0.0, 2.0 * rotated.y(), -2.0 * rotated.x(), 0.0, 0.0, 0.0, 1.0;
  return J;
}

}  // namespace

struct StateCovariance::Impl {
  Impl(const DeformationGraph& of_graph, const DeformationState& at_state)
      : graph(of_graph), state(at_state) {}

  bool IsKnown(const std::vector<BlockDerivative>& parts) const;
  std::vector<BlockDerivative> PointParts(const Eigen::Vector3d& position,
                                          const Binding& binding,
                                          const Eigen::Matrix3d& frame) const;
  Eigen::MatrixXd Propagate(const std::vector<BlockDerivative>& parts, int rows) const;
  bool IsAbsent(int node) const;
  bool TouchesAbsent(const Binding& binding) const;

  const DeformationGraph& graph;
  const DeformationState state;
  std::vector<ParameterStatus> status;
  ParameterStatus camera_status = ParameterStatus::kHeld;
  std::vector<int> undetermined;
  // The block of each node and of the camera, or -1 if it is not variable.
  std::vector<int> block_of_node;
  int camera_block = -1;
  std::unique_ptr<const RegularizedInverse> inverse;
};

StateCovariance::StateCovariance(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StateCovariance::StateCovariance(StateCovariance&&) noexcept = default;
StateCovariance& StateCovariance::operator=(StateCovariance&&) noexcept = default;
StateCovariance::~StateCovariance() = default;

StatusOr<StateCovariance> StateCovariance::Compute(const ProblemBuilder& builder,
                                                   const ProblemConfig& config,
                                                   const DeformationState& state,
                                                   const CovarianceOptions& options) {
  if (Status status = builder.status(); !status.ok()) return status;
  auto impl = std::make_unique<Impl>(builder.graph(), state);
  NormalEquations equations(builder, config);
  const int num_nodes = builder.graph().num_nodes();
  impl->block_of_node.assign(num_nodes, -1);
  for (int i = 0; i < equations.num_variable_nodes(); ++i) {
    impl->block_of_node[equations.variable_nodes()[i]] = i;
  }
  if (equations.camera_variable()) impl->camera_block = equations.num_variable_nodes();

  // J^T J, with room for the pairs of nodes to which a common point is bound.
  std::vector<BlockPair> pairs = equations.BlockPairs();
  if (options.skinning != nullptr) {
    const std::vector<BlockPair> more = PairsOf(*options.skinning, impl->block_of_node);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  BlockStructure structure(equations.BlockSizes(), pairs);
  CHECK(equations.SetStructure(&structure));
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
  if (equations.Evaluate(state, options.num_threads, &cost, &values, &gradient)) {
    impl->inverse = RegularizedInverse::Create(std::move(structure), values, options.num_threads);
  }
  if (impl->inverse == nullptr) {
    if (Status status = builder.CheckResiduals(state); !status.ok()) return status;
    return Status::Error(
        "the residuals have derivatives too large, or not finite, for covariances");
  }

  const auto status_of = [&](int block) {
    return impl->inverse->is_determined(block) ? ParameterStatus::kDetermined
                                               : ParameterStatus::kUndetermined;
  };
  for (int j = 0; j < num_nodes; ++j) {
    const bool eliminated = !config.eliminated_nodes.empty() && config.eliminated_nodes[j] != 0;
    impl->status.push_back(eliminated ? ParameterStatus::kEliminated : ParameterStatus::kHeld);
    if (impl->block_of_node[j] >= 0) {
      impl->status[j] = status_of(impl->block_of_node[j]);
    } else if (config.variable_nodes[j] != 0) {
      // The node is variable, but no residual depends on it.
      impl->status[j] = ParameterStatus::kUndetermined;
    }
    if (impl->status[j] == ParameterStatus::kUndetermined) impl->undetermined.push_back(j);
  }
  if (impl->camera_block >= 0) {
    impl->camera_status = status_of(impl->camera_block);
  } else if (config.camera_variable) {
    impl->camera_status = ParameterStatus::kUndetermined;
  }
  return StateCovariance(std::move(impl));
}

ParameterStatus StateCovariance::status(int node) const { return impl_->status[node]; }

ParameterStatus StateCovariance::camera_status() const { return impl_->camera_status; }

const std::vector<int>& StateCovariance::undetermined() const { return impl_->undetermined; }

bool StateCovariance::Impl::IsKnown(const std::vector<BlockDerivative>& parts) const {
  return std::all_of(parts.begin(), parts.end(), [&](const BlockDerivative& part) {
    return inverse->is_determined(part.block);
  });
}

Eigen::MatrixXd StateCovariance::Impl::Propagate(const std::vector<BlockDerivative>& parts,
                                                 int rows) const {
  if (!IsKnown(parts)) return NotANumber(rows);
  if (parts.empty()) return Eigen::MatrixXd::Zero(rows, rows);
  return inverse->Propagate(parts);
}

// Returns whether a node is neither held nor part of the problem.
bool StateCovariance::Impl::IsAbsent(int node) const {
  return block_of_node[node] < 0 && status[node] != ParameterStatus::kHeld;
}

bool StateCovariance::Impl::TouchesAbsent(const Binding& binding) const {
  return std::any_of(
      binding.nodes, binding.nodes + binding.size, [this](int node) { return IsAbsent(node); });
}

// Returns the derivatives of a warped point (Eq. 1): frame * w_j [x I, y I, z I, I] with (x, y, z)
// = position - g_j.
std::vector<BlockDerivative> StateCovariance::Impl::PointParts(const Eigen::Vector3d& position,
                                                               const Binding& binding,
                                                               const Eigen::Matrix3d& frame) const {
  std::vector<BlockDerivative> parts;
  for (int i = 0; i < binding.size; ++i) {
    const int block = block_of_node[binding.nodes[i]];
    if (block < 0) continue;
    const Eigen::Vector3d lever = position - graph.position(binding.nodes[i]);
    BlockDerivative part = {block, Eigen::MatrixXd(3, kNodeSize)};
    for (int c = 0; c < 3; ++c) {
      part.jacobian.middleCols<3>(3 * c) = binding.weights[i] * lever[c] * frame;
    }
    part.jacobian.rightCols<3>() = binding.weights[i] * frame;
    parts.push_back(std::move(part));
  }
  return parts;
}

Eigen::MatrixXd StateCovariance::Node(int node) const {
  if (impl_->IsAbsent(node)) return NotANumber(kNodeSize);
  std::vector<BlockDerivative> parts;
  if (const int block = impl_->block_of_node[node]; block >= 0) {
    parts.push_back({block, Eigen::MatrixXd::Identity(kNodeSize, kNodeSize)});
  }
  return impl_->Propagate(parts, kNodeSize);
}

Eigen::VectorXd StateCovariance::SolveNodes(const Eigen::VectorXd& force) const {
  const BlockStructure& structure = impl_->inverse->structure();
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(structure.num_rows());
  const int num_nodes = impl_->graph.num_nodes();
  for (int j = 0; j < num_nodes; ++j) {
    const int block = impl_->block_of_node[j];
    if (block < 0) continue;
    rhs.segment<kNodeSize>(structure.row_offset(block)) = force.segment<kNodeSize>(kNodeSize * j);
  }
  const Eigen::VectorXd solved = impl_->inverse->Solve(rhs);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(force.size());
  for (int j = 0; j < num_nodes; ++j) {
    const int block = impl_->block_of_node[j];
    if (block < 0) continue;
    change.segment<kNodeSize>(kNodeSize * j) =
        solved.segment<kNodeSize>(structure.row_offset(block));
  }
  return change;
}

Eigen::MatrixXd StateCovariance::Camera() const {
  std::vector<BlockDerivative> parts;
  if (impl_->camera_block >= 0) {
    parts.push_back({impl_->camera_block, Eigen::MatrixXd::Identity(kCameraSize, kCameraSize)});
  }
  return impl_->Propagate(parts, kCameraSize);
}

Eigen::Matrix3d StateCovariance::Point(const Eigen::Vector3d& position,
                                       const Binding& binding) const {
  if (impl_->TouchesAbsent(binding)) return NotANumber(3);
  return impl_->Propagate(impl_->PointParts(position, binding, Eigen::Matrix3d::Identity()), 3);
}

Eigen::Matrix3d StateCovariance::PointInCamera(const Eigen::Vector3d& position,
                                               const Binding& binding) const {
  if (impl_->TouchesAbsent(binding)) return NotANumber(3);
  const CameraPose& pose = impl_->state.camera_from_map;
  std::vector<BlockDerivative> parts =
      impl_->PointParts(position, binding, pose.rotation.toRotationMatrix());
  if (impl_->camera_block >= 0) {
    const Eigen::Vector3d warped = WarpPoint(impl_->graph, impl_->state, binding, position);
    parts.push_back({impl_->camera_block, CameraDerivative(pose.rotation * warped)});
  }
  return impl_->Propagate(parts, 3);
}

}  // namespace ceres_ed
