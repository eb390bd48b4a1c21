// The part of NormalEquations that treats observed points.
#include <ceres_ed/solver/normal_equations/group_products.h>
#include <ceres_ed/solver/normal_equations/loss_correction.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

// The number of residuals that are evaluated at once.
constexpr int kBatch = 32;

// Adds D^T D and D^T r, where D is the derivative with respect to the point in the map frame.
void AddMoments(double scale,
                int num_residuals,
                const double* residuals,
                const double* jacobian,
                const Eigen::Matrix3d* R_c,
                double* moments,
                double* gradient) {
  for (int k = 0; k < num_residuals; ++k) {
    Eigen::RowVector3d d = Eigen::Map<const Eigen::RowVector3d>(jacobian + 3 * k);
    if (R_c != nullptr) d = (d * *R_c).eval();
    const Eigen::RowVector3d scaled = scale * d;
    moments[0] += scaled[0] * d[0];
    moments[1] += scaled[1] * d[0];
    moments[2] += scaled[1] * d[1];
    moments[3] += scaled[2] * d[0];
    moments[4] += scaled[2] * d[1];
    moments[5] += scaled[2] * d[2];
    for (int i = 0; i < 3; ++i) gradient[i] += residuals[k] * scaled[i];
  }
}

}  // namespace

// The buffers of one task for one group at a time; each has a fixed number of values per point.
struct NormalEquations::PointScratch {
  PointScratch(int max_points, int max_residuals)
      : in_map(3 * max_points),
        in_frame(3 * max_points),
        moments(6 * max_points),
        gradients(3 * max_points),
        residuals(kBatch * max_residuals),
        jacobians(3 * kBatch * max_residuals) {}

  // The warped points in the map frame and in the frame of the residuals.
  std::vector<double> in_map;
  std::vector<double> in_frame;
  std::vector<double> moments;
  std::vector<double> gradients;
  std::vector<double> residuals;
  std::vector<double> jacobians;
  double batch[3 * kBatch];
  // The rotation of the camera; it is used for points with a camera only.
  const Eigen::Matrix3d* R_c = nullptr;
  GroupSums sums;
};

// Warps the points of a group (Eq. 1): sum_a w_a [A_a (v - g_a) + g_a + t_a] = (sum_a w_a A_a) h +
// sum_a w_a c_a, where h = v - g_0 and c_a is the image of g_0 under node a.
void NormalEquations::WarpGroup(const PointGroup& group,
                                const DeformationState& state,
                                PointScratch* scratch) const {
  using Affine = Eigen::Matrix<double, 3, 4>;
  Affine nodes[kMaxBoundNodes];
  const Eigen::Vector3d* positions = &group_positions_[group.first_node];
  for (int a = 0; a < group.num_nodes; ++a) {
    const double* node = state.node(points_.nodes(group)[a]);
    nodes[a].leftCols<3>() = NodeAffine(node);
    nodes[a].col(3) =
        NodeAffine(node) * (positions[0] - positions[a]) + positions[a] + NodeTranslation(node);
  }
  WarpPoints(group.num_points,
             group.num_nodes,
             points_.levers(group),
             points_.weights(group),
             nodes[0].data(),
             scratch->in_map.data());
  for (int p = 0; p < group.num_points; ++p) {
    const Eigen::Map<const Eigen::Vector3d> in_map(&scratch->in_map[3 * p]);
    Eigen::Map<Eigen::Vector3d> in_frame(&scratch->in_frame[3 * p]);
    if (group.has_camera) {
      in_frame = *scratch->R_c * in_map + state.camera_from_map.translation;
    } else {
      in_frame = in_map;
    }
  }
}

// Evaluates some residuals of a run at the points in `scratch->batch`, or takes the values of a
// batch function, which has been evaluated already.
bool NormalEquations::EvaluateRun(
    const PointRun& run, int begin, int count, bool linearize, PointScratch* scratch) const {
  const int* const indices = points_.indices(run) + begin;
  double* const jacobians = linearize ? scratch->jacobians.data() : nullptr;
  if (batches_.empty() || run.store->AsBatch() == nullptr) {
    return run.store->EvaluateAtPoints(
        count, indices, scratch->batch, scratch->residuals.data(), jacobians);
  }
  const int size = run.store->num_residuals();
  for (int k = 0; k < count; ++k) {
    std::copy_n(batches_.Residuals(run.store, indices[k]), size, &scratch->residuals[size * k]);
    if (!linearize) continue;
    std::copy_n(batches_.Jacobian(run.store, indices[k]), 3 * size, jacobians + 3 * size * k);
  }
  return true;
}

// Evaluates the residuals of one run at the warped points, and adds their cost, M = D^T D and v =
// D^T r.
bool NormalEquations::AddRun(const PointRun& run,
                             bool has_camera,
                             bool linearize,
                             PointScratch* scratch,
                             double* cost) const {
  const int num_residuals = run.store->num_residuals();
  const int* points = points_.points(run);
  double* jacobians = linearize ? scratch->jacobians.data() : nullptr;
  for (int begin = 0; begin < run.num_residuals; begin += kBatch) {
    const int count = std::min(kBatch, run.num_residuals - begin);
    for (int k = 0; k < count; ++k) {
      std::copy_n(&scratch->in_frame[3 * points[begin + k]], 3, scratch->batch + 3 * k);
    }
    if (!EvaluateRun(run, begin, count, linearize, scratch)) return false;
    for (int k = 0; k < count; ++k) {
      double* residuals = &scratch->residuals[num_residuals * k];
      double rho[3];
      if (!ApplyLoss(run.term,
                     points_.residual_weights(run)[begin + k],
                     num_residuals,
                     residuals,
                     rho,
                     cost)) {
        return false;
      }
      if (!linearize) continue;
      double* jacobian = jacobians + 3 * num_residuals * k;
      double scale = rho[1];
      // For a concave loss the correction is the factor rho' on the products. Other losses need
      // Triggs' correction of residuals and Jacobian.
      if (rho[2] > 0.0) {
        const double squared_norm =
            Eigen::Map<const Eigen::VectorXd>(residuals, num_residuals).squaredNorm();
        const LossCorrection correction(squared_norm, rho);
        correction.CorrectJacobian(residuals, num_residuals, 3, jacobian);
        correction.CorrectResiduals(num_residuals, residuals);
        scale = 1.0;
      }
      AddMoments(scale,
                 num_residuals,
                 residuals,
                 jacobian,
                 has_camera ? scratch->R_c : nullptr,
                 &scratch->moments[6 * points[begin + k]],
                 &scratch->gradients[3 * points[begin + k]]);
    }
  }
  return true;
}

// Warps the points of a group, evaluates their residuals and adds their products to the equations.
bool NormalEquations::AddGroup(int index,
                               const DeformationState& state,
                               const Sums& sums,
                               PointScratch* scratch,
                               double* cost) const {
  const PointGroup& group = points_.groups()[index];
  WarpGroup(group, state, scratch);
  std::fill_n(scratch->moments.begin(), 6 * group.num_points, 0.0);
  std::fill_n(scratch->gradients.begin(), 3 * group.num_points, 0.0);
  for (int i = 0; i < group.num_runs; ++i) {
    const PointRun& run = points_.runs(group)[i];
    if (!AddRun(run, group.has_camera, sums.gradient != nullptr, scratch, cost)) return false;
  }
  if (sums.gradient == nullptr) return true;
  LinearizedPoints points;
  points.count = group.num_points;
  points.num_nodes = group.num_nodes;
  points.levers = points_.levers(group);
  points.weights = points_.weights(group);
  points.moments = scratch->moments.data();
  points.gradients = scratch->gradients.data();
  if (VariesCamera(group)) points.warped = scratch->in_map.data();
  scratch->sums.SetZero(group.num_nodes);
  AddGroupGradients(points, &scratch->sums);
  SpreadGradients(index, *scratch, sums);
  if (sums.values == nullptr) return true;
  if (num_dual_points_ > 0) {
    SpreadDuals(index, scratch->moments.data(), sums);
    return true;
  }
  AddGroupProducts(points, &scratch->sums);
  SpreadProducts(index, *scratch, sums);
  return true;
}

void NormalEquations::SpreadGradients(int index,
                                      const PointScratch& scratch,
                                      const Sums& sums) const {
  const PointGroup& group = points_.groups()[index];
  const Eigen::Vector3d* positions = &group_positions_[group.first_node];
  const int* blocks = &group_blocks_[group.first_node];
  for (int a = 0; a < group.num_nodes; ++a) {
    if (blocks[a] < 0) continue;
    double* g = Gradient(DiagonalSlot(index, a), sums);
    const double* from = scratch.sums.gradients[a];
    // The sums have levers relative to the first node; the shift makes them relative to node a.
    const Eigen::Vector3d shift = positions[0] - positions[a];
    for (int i = 0; i < 4; ++i) {
      for (int r = 0; r < 3; ++r) {
        g[3 * i + r] += i < 3 ? from[3 * i + r] + shift[i] * from[9 + r] : from[9 + r];
      }
    }
  }
  if (!VariesCamera(group)) return;
  const int camera_slot = group_slots_[index] + NumGroupSlots(group) - 1;
  Eigen::Map<Eigen::Matrix<double, 6, 1>> g(Gradient(camera_slot, sums));
  g.head<3>() += 2.0 * (*scratch.R_c * scratch.sums.turn_gradient);
  g.tail<3>() += *scratch.R_c * scratch.sums.shift_gradient;
}

void NormalEquations::SpreadProducts(int index,
                                     const PointScratch& scratch,
                                     const Sums& sums) const {
  const PointGroup& group = points_.groups()[index];
  const Eigen::Vector3d* positions = &group_positions_[group.first_node];
  const int* blocks = &group_blocks_[group.first_node];
  Eigen::Vector3d shifts[kMaxBoundNodes];
  for (int a = 0; a < group.num_nodes; ++a) shifts[a] = positions[0] - positions[a];
  int slot = group_slots_[index];
  for (int a = 0, pair = 0; a < group.num_nodes; ++a) {
    for (int b = 0; b <= a; ++b, ++pair, ++slot) {
      if (blocks[a] < 0 || blocks[b] < 0) continue;
      const bool a_is_row = blocks[a] >= blocks[b];
      AddPairBlock(scratch.sums.pairs[pair],
                   shifts[a_is_row ? a : b].data(),
                   shifts[a_is_row ? b : a].data(),
                   Values(slot, sums));
    }
  }
  if (!VariesCamera(group)) return;
  for (int a = 0; a < group.num_nodes; ++a, ++slot) {
    if (blocks[a] < 0) continue;
    AddCameraBlock(
        scratch.sums.camera_nodes[a], shifts[a].data(), *scratch.R_c, Values(slot, sums));
  }
  const Eigen::Matrix3d& R_c = *scratch.R_c;
  Eigen::Map<Eigen::Matrix<double, 6, 6>> H(Values(slot, sums));
  const Eigen::Matrix3d turn_shift = 2.0 * R_c * scratch.sums.turn_shift * R_c.transpose();
  H.topLeftCorner<3, 3>() += 4.0 * R_c * scratch.sums.turn_turn * R_c.transpose();
  H.topRightCorner<3, 3>() += turn_shift;
  H.bottomLeftCorner<3, 3>() += turn_shift.transpose();
  H.bottomRightCorner<3, 3>() += R_c * scratch.sums.shift_shift * R_c.transpose();
}

bool NormalEquations::AddGroups(const Task& task,
                                const DeformationState& state,
                                const Sums& sums,
                                double* cost) const {
  if (task.groups.empty()) return true;
  const auto scratch =
      std::make_unique<PointScratch>(points_.max_points(), points_.max_residuals());
  const Eigen::Matrix3d R_c = state.camera_from_map.rotation.toRotationMatrix();
  scratch->R_c = &R_c;
  for (const int g : task.groups) {
    if (!AddGroup(g, state, sums, scratch.get(), cost)) return false;
  }
  return true;
}

}  // namespace ceres_ed
