// Two classes that turn a functor of a warped point into a Ceres cost function.
//
// A point functor does not depend on the graph:
//   struct MyFunctor {
//     static constexpr int kNumResiduals = 1;
//     template <typename T> bool operator()(const T* point, T* residuals) const;
//   };
// `point` is the warped point (3 values, in map units). It is in the camera frame if there is a
// camera, and in the map frame otherwise. The functor returns false if it can't be evaluated.
#ifndef CERES_ED_COST_FUNCTIONS_WARPED_POINT_COST_H_
#define CERES_ED_COST_FUNCTIONS_WARPED_POINT_COST_H_

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include <Eigen/Core>
#include <ceres/autodiff_cost_function.h>
#include <ceres/cost_function.h>
#include <ceres/jet.h>
#include <cost_functions/node_parameters.h>
#include <cost_functions/warp.h>
#include <glog/logging.h>

namespace ceres_ed {

// Evaluates a point functor at the warped point. Writes its residuals and, unless `jacobian` is
// null, their derivative with respect to the point (kNumResiduals x 3, row-major). Returns false if
// the functor fails.
template <typename Functor>
bool EvaluatePointFunctor(const Functor& functor,
                          const double* warped,
                          double* residuals,
                          double* jacobian) {
  if (jacobian == nullptr) return functor(warped, residuals);
  using Jet = ceres::Jet<double, 3>;
  const Jet jets[3] = {Jet(warped[0], 0), Jet(warped[1], 1), Jet(warped[2], 2)};
  Jet jet_residuals[Functor::kNumResiduals];
  if (!functor(jets, jet_residuals)) return false;
  for (int r = 0; r < Functor::kNumResiduals; ++r) {
    residuals[r] = jet_residuals[r].a;
    for (int i = 0; i < 3; ++i) jacobian[3 * r + i] = jet_residuals[r].v[i];
  }
  return true;
}

// The fast version. It evaluates the functor with jets of width 3 and applies the chain rule with
// the analytic Jacobian of the warp. It gives the same numbers as CreateAutoDiffWarpedPointCost()
// in a tenth of the time.
// Parameter blocks: the point's nodes (12 each), then, with a camera, R_c (4) and T_c (3).
template <typename Functor>
class WarpedPointCost final : public ceres::CostFunction {
 public:
  static constexpr int kNumResiduals = Functor::kNumResiduals;

  // `has_camera` says whether the point is taken into the camera frame.
  WarpedPointCost(Functor functor, const BoundPoint& point, bool has_camera)
      : point_(point), has_camera_(has_camera), functor_(std::move(functor)) {
    set_num_residuals(kNumResiduals);
    mutable_parameter_block_sizes()->assign(point.num_nodes(), kNodeSize);
    if (has_camera) {
      mutable_parameter_block_sizes()->push_back(kRotationSize);
      mutable_parameter_block_sizes()->push_back(kTranslationSize);
    }
  }

  // Computes the residuals and, where asked for, the Jacobians. Returns false if the functor fails.
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const int num_nodes = point_.num_nodes();
    // The warped point: into the map frame, then into the camera frame (Eq. 1).
    const Eigen::Vector3d point_in_map = WarpToMap(point_, parameters);
    const double* rotation = has_camera_ ? parameters[num_nodes] : nullptr;
    const double* translation = has_camera_ ? parameters[num_nodes + 1] : nullptr;
    const Eigen::Vector3d warped =
        has_camera_ ? MapToCamera(rotation, translation, point_in_map) : point_in_map;
    if (jacobians == nullptr) return functor_(warped.data(), residuals);

    // The chain rule: derivative by the warped point, then by the point in the map, then by the
    // blocks.
    double derivative[3 * kNumResiduals];
    if (!EvaluatePointFunctor(functor_, warped.data(), residuals, derivative)) return false;
    const PointJacobian by_warped = ConstPointJacobianMap(derivative);
    PointJacobian by_map = by_warped;
    if (has_camera_) {
      const Eigen::Map<const Eigen::Quaterniond> R_c(rotation);
      by_map = by_warped * R_c.toRotationMatrix();
      FillCameraJacobians(point_in_map, R_c, by_warped, jacobians + num_nodes);
    }
    FillNodeJacobians(by_map, jacobians);
    return true;
  }

 private:
  using PointJacobian = Eigen::Matrix<double, kNumResiduals, 3>;
  using ConstPointJacobianMap =
      Eigen::Map<const Eigen::Matrix<double, kNumResiduals, 3, Eigen::RowMajor>>;
  template <int kCols>
  using BlockJacobian = Eigen::Map<Eigen::Matrix<double, kNumResiduals, kCols, Eigen::RowMajor>>;

  // Writes the Jacobians of the nodes: d residual / d A_j column c = w_j (v - g_j)_c d residual / d
  // p, and d residual / d t_j = w_j d residual / d p. Ceres passes a null pointer for each block
  // that is held constant, so each pointer is tested.
  void FillNodeJacobians(const PointJacobian& by_map, double** jacobians) const {
    for (int i = 0; i < point_.num_nodes(); ++i) {
      if (jacobians[i] == nullptr) continue;
      BlockJacobian<kNodeSize> J(jacobians[i]);
      const PointJacobian by_translation = point_.weight(i) * by_map;
      for (int c = 0; c < 3; ++c) {
        J.template middleCols<3>(3 * c) = point_.offset(i)[c] * by_translation;
      }
      J.template middleCols<3>(kNodeTranslationOffset) = by_translation;
    }
  }

  // Writes the Jacobians of R_c and T_c, unless Ceres passes a null pointer for them.
  static void FillCameraJacobians(const Eigen::Vector3d& p,
                                  const Eigen::Quaterniond& R_c,
                                  const PointJacobian& by_warped,
                                  double** jacobians) {
    if (jacobians[0] != nullptr) {
      BlockJacobian<kRotationSize> J(jacobians[0]);
      J = by_warped * RotatedByQuaternion(R_c, p);
    }
    if (jacobians[1] != nullptr) {
      BlockJacobian<kTranslationSize> J(jacobians[1]);
      J = by_warped;
    }
  }

  BoundPoint point_;
  bool has_camera_;
  Functor functor_;
};

namespace internal {

// Collects in an array the parameter blocks that AutoDiffCostFunction passes as separate arguments.
template <typename Functor, bool kHasCamera>
class AutoDiffWarpedPoint {
 public:
  AutoDiffWarpedPoint(Functor functor, const BoundPoint& point)
      : functor_(std::move(functor)), point_(point) {}

  template <typename T, typename... Rest>
  bool operator()(const T* first, Rest... rest) const {
    T* residuals = std::get<sizeof...(Rest)>(std::tuple<const T*, Rest...>(first, rest...));
    const std::array<const T*, sizeof...(Rest) + 1> blocks{first, rest...};
    Eigen::Matrix<T, 3, 1> warped = WarpToMap(point_, blocks.data());
    if constexpr (kHasCamera) {
      warped = MapToCamera(blocks[point_.num_nodes()], blocks[point_.num_nodes() + 1], warped);
    }
    return functor_(warped.data(), residuals);
  }

 private:
  Functor functor_;
  BoundPoint point_;
};

// kNodeSize, repeated for each element of a parameter pack.
template <std::size_t>
inline constexpr int kSizeOfNode = kNodeSize;

template <typename Functor, std::size_t... kNodes>
ceres::CostFunction* CreateAutoDiffWarpedPoint(Functor functor,
                                               const BoundPoint& point,
                                               bool has_camera,
                                               std::index_sequence<kNodes...> /*nodes*/) {
  if (has_camera) {
    using Carrier = AutoDiffWarpedPoint<Functor, true>;
    return new ceres::AutoDiffCostFunction<Carrier,
                                           Functor::kNumResiduals,
                                           kSizeOfNode<kNodes>...,
                                           kRotationSize,
                                           kTranslationSize>(
        new Carrier(std::move(functor), point));
  }
  using Carrier = AutoDiffWarpedPoint<Functor, false>;
  return new ceres::AutoDiffCostFunction<Carrier, Functor::kNumResiduals, kSizeOfNode<kNodes>...>(
      new Carrier(std::move(functor), point));
}

}  // namespace internal

// Returns the plain version, which the fast one is tested against: automatic differentiation with
// respect to all blocks at once. It has the same parameter blocks. Fails a CHECK unless
// `point.num_nodes()` is kNumNodes. The caller owns the result.
template <int kNumNodes, typename Functor>
ceres::CostFunction* CreateAutoDiffWarpedPointCost(Functor functor,
                                                   const BoundPoint& point,
                                                   bool has_camera) {
  CHECK_EQ(point.num_nodes(), kNumNodes);
  return internal::CreateAutoDiffWarpedPoint(
      std::move(functor), point, has_camera, std::make_index_sequence<kNumNodes>());
}

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_WARPED_POINT_COST_H_
