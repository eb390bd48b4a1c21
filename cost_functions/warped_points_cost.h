// Functors of several warped points at once, for lengths between points, areas and volumes:
//
//   struct MyFunctor {
//     static constexpr int kNumResiduals = 1;
//     template <typename T>
//     bool operator()(const T* a, const T* b, const T* c, T* residuals) const;
//   };
// Each argument before the last is a warped point as in warped_point_cost.h.
#ifndef CERES_ED_COST_FUNCTIONS_WARPED_POINTS_COST_H_
#define CERES_ED_COST_FUNCTIONS_WARPED_POINTS_COST_H_

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ceres/cost_function.h>
#include <ceres/jet.h>
#include <cost_functions/node_parameters.h>
#include <cost_functions/warp.h>
#include <glog/logging.h>

namespace ceres_ed {

// A cost function of a functor of kNumPoints warped points. It evaluates the functor with jets of
// width 3 kNumPoints and applies the chain rule with the analytic Jacobian of the warp.
// Parameter blocks: `num_nodes` nodes (12 each), then, with a camera, R_c (4) and T_c (3).
template <typename Functor, int kNumPoints>
class WarpedPointsCost final : public ceres::CostFunction {
 public:
  static constexpr int kNumResiduals = Functor::kNumResiduals;

  // A point, and for each of its nodes the index of the parameter block.
  struct Point {
    BoundPoint bound;
    std::array<int, kMaxBoundNodes> blocks;
  };

  // Fails a CHECK on a block index that is not in [0, num_nodes). `has_camera` says whether the
  // points are taken into the camera frame.
  WarpedPointsCost(Functor functor,
                   std::array<Point, kNumPoints> points,
                   int num_nodes,
                   bool has_camera)
      : points_(std::move(points)),
        num_nodes_(num_nodes),
        has_camera_(has_camera),
        functor_(std::move(functor)) {
    set_num_residuals(kNumResiduals);
    mutable_parameter_block_sizes()->assign(num_nodes, kNodeSize);
    if (has_camera) {
      mutable_parameter_block_sizes()->push_back(kRotationSize);
      mutable_parameter_block_sizes()->push_back(kTranslationSize);
    }
    for (const Point& point : points_) {
      for (int i = 0; i < point.bound.num_nodes(); ++i) {
        CHECK(point.blocks[i] >= 0 && point.blocks[i] < num_nodes) << "block " << point.blocks[i];
      }
    }
  }

  // Computes the residuals and, where asked for, the Jacobians. Returns false if the functor fails.
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    std::array<Eigen::Vector3d, kNumPoints> in_map;
    std::array<Eigen::Vector3d, kNumPoints> warped;
    for (int p = 0; p < kNumPoints; ++p) {
      in_map[p] = Warp(points_[p], parameters);
      warped[p] = has_camera_
                      ? MapToCamera(parameters[num_nodes_], parameters[num_nodes_ + 1], in_map[p])
                      : in_map[p];
    }
    if (jacobians == nullptr) return EvaluateValues(warped, residuals, Indices());
    std::array<PointJacobian, kNumPoints> by_warped;
    if (!EvaluateJets(warped, residuals, &by_warped, Indices())) return false;
    SetZero(jacobians);
    if (has_camera_) AddCameraJacobians(parameters, in_map, &by_warped, jacobians);
    for (int p = 0; p < kNumPoints; ++p) AddNodeJacobians(points_[p], by_warped[p], jacobians);
    return true;
  }

 private:
  using PointJacobian = Eigen::Matrix<double, kNumResiduals, 3>;
  using Indices = std::make_index_sequence<kNumPoints>;
  template <int kCols>
  using BlockJacobian = Eigen::Map<Eigen::Matrix<double, kNumResiduals, kCols, Eigen::RowMajor>>;

  static Eigen::Vector3d Warp(const Point& point, double const* const* parameters) {
    const double* nodes[kMaxBoundNodes];
    for (int i = 0; i < point.bound.num_nodes(); ++i) nodes[i] = parameters[point.blocks[i]];
    return WarpToMap(point.bound, nodes);
  }

  template <std::size_t... kPoint>
  bool EvaluateValues(const std::array<Eigen::Vector3d, kNumPoints>& warped,
                      double* residuals,
                      std::index_sequence<kPoint...> /*points*/) const {
    return functor_(warped[kPoint].data()..., residuals);
  }

  template <std::size_t... kPoint>
  bool EvaluateJets(const std::array<Eigen::Vector3d, kNumPoints>& warped,
                    double* residuals,
                    std::array<PointJacobian, kNumPoints>* by_warped,
                    std::index_sequence<kPoint...> /*points*/) const {
    using Jet = ceres::Jet<double, 3 * kNumPoints>;
    Jet points[kNumPoints][3];
    for (int p = 0; p < kNumPoints; ++p) {
      for (int i = 0; i < 3; ++i) points[p][i] = Jet(warped[p][i], 3 * p + i);
    }
    Jet jets[kNumResiduals];
    if (!functor_(static_cast<const Jet*>(points[kPoint])..., jets)) return false;
    for (int r = 0; r < kNumResiduals; ++r) {
      residuals[r] = jets[r].a;
      for (int p = 0; p < kNumPoints; ++p) {
        for (int i = 0; i < 3; ++i) (*by_warped)[p](r, i) = jets[r].v[3 * p + i];
      }
    }
    return true;
  }

  // Sets all Jacobians to zero. Ceres passes a null pointer for each block that is held constant,
  // so each pointer is tested.
  void SetZero(double** jacobians) const {
    const std::vector<int>& sizes = this->parameter_block_sizes();
    for (std::size_t b = 0; b < sizes.size(); ++b) {
      if (jacobians[b] == nullptr) continue;
      Eigen::Map<Eigen::VectorXd>(jacobians[b], kNumResiduals * sizes[b]).setZero();
    }
  }

  // Adds to the Jacobians of R_c and T_c, and replaces the derivatives with respect to points in
  // the camera frame by those with respect to points in the map frame.
  void AddCameraJacobians(double const* const* parameters,
                          const std::array<Eigen::Vector3d, kNumPoints>& in_map,
                          std::array<PointJacobian, kNumPoints>* by_warped,
                          double** jacobians) const {
    const Eigen::Map<const Eigen::Quaterniond> R_c(parameters[num_nodes_]);
    for (int p = 0; p < kNumPoints; ++p) {
      PointJacobian& derivative = (*by_warped)[p];
      if (jacobians[num_nodes_] != nullptr) {
        BlockJacobian<kRotationSize>(jacobians[num_nodes_]) +=
            derivative * RotatedByQuaternion(R_c, in_map[p]);
      }
      if (jacobians[num_nodes_ + 1] != nullptr) {
        BlockJacobian<kTranslationSize>(jacobians[num_nodes_ + 1]) += derivative;
      }
      derivative = (derivative * R_c.toRotationMatrix()).eval();
    }
  }

  // Adds the part of one point to the Jacobians of its nodes.
  static void AddNodeJacobians(const Point& point,
                               const PointJacobian& by_map,
                               double** jacobians) {
    for (int i = 0; i < point.bound.num_nodes(); ++i) {
      double* jacobian = jacobians[point.blocks[i]];
      if (jacobian == nullptr) continue;
      BlockJacobian<kNodeSize> J(jacobian);
      const PointJacobian by_translation = point.bound.weight(i) * by_map;
      for (int c = 0; c < 3; ++c) {
        J.template middleCols<3>(3 * c) += point.bound.offset(i)[c] * by_translation;
      }
      J.template middleCols<3>(kNodeTranslationOffset) += by_translation;
    }
  }

  std::array<Point, kNumPoints> points_;
  int num_nodes_;
  bool has_camera_;
  Functor functor_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_WARPED_POINTS_COST_H_
