// The volume of a closed mesh whose vertices are warped.
#ifndef CERES_ED_COST_FUNCTIONS_VOLUME_COST_H_
#define CERES_ED_COST_FUNCTIONS_VOLUME_COST_H_

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ceres/cost_function.h>
#include <cost_functions/node_parameters.h>
#include <cost_functions/warp.h>
#include <glog/logging.h>

namespace ceres_ed {

// Returns the volume that triangles enclose, in cubic map units. The triangles are
// counter-clockwise as seen from outside. By the divergence theorem it is the sum of a . (b x c) /
// 6 over the triangles, where the corners are taken relative to `origin`. The origin may be any
// point; a point near the mesh keeps rounding errors small.
inline double EnclosedVolume(const std::vector<Eigen::Vector3d>& points,
                             const std::vector<std::array<int, 3>>& triangles,
                             const Eigen::Vector3d& origin) {
  double six_volumes = 0.0;
  for (const std::array<int, 3>& t : triangles) {
    const Eigen::Vector3d a = points[t[0]] - origin;
    six_volumes += a.dot((points[t[1]] - origin).cross(points[t[2]] - origin));
  }
  return six_volumes / 6.0;
}

// The relative change of the volume of a closed mesh. It has one residual, without a unit:
//   (V - V_0) / V_0
// The derivative of V with respect to a vertex is a third of the sum of the area vectors of its
// triangles.
// Parameter blocks: the nodes to which the vertices are bound (12 each).
class VolumeCost final : public ceres::CostFunction {
 public:
  // A vertex, and for each of its nodes the index of the parameter block.
  struct Vertex {
    BoundPoint bound;
    std::array<int, kMaxBoundNodes> blocks;
  };

  // `triangles` has indices into `vertices`. `rest_volume` is V_0, in cubic map units, and is not
  // 0. `num_nodes` >= 1 is the number of parameter blocks.
  VolumeCost(std::vector<Vertex> vertices,
             std::vector<std::array<int, 3>> triangles,
             double rest_volume,
             int num_nodes)
      : vertices_(std::move(vertices)), triangles_(std::move(triangles)), volume_(rest_volume) {
    CHECK(rest_volume != 0.0) << "a volume of 0 can't be kept";
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(num_nodes, kNodeSize);
  }

  // Computes the residual and, where asked for, the Jacobians. Always returns true.
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    std::vector<Eigen::Vector3d> warped;
    warped.reserve(vertices_.size());
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    for (const Vertex& vertex : vertices_) {
      const double* nodes[kMaxBoundNodes];
      for (int i = 0; i < vertex.bound.num_nodes(); ++i) nodes[i] = parameters[vertex.blocks[i]];
      warped.push_back(WarpToMap(vertex.bound, nodes));
      origin += warped.back() / static_cast<double>(vertices_.size());
    }
    residuals[0] = EnclosedVolume(warped, triangles_, origin) / volume_ - 1.0;
    if (jacobians != nullptr) FillJacobians(ByVertex(warped, origin), jacobians);
    return true;
  }

 private:
  // Returns the derivative of the residual with respect to each vertex. Since the mesh is closed,
  // the derivative with respect to the origin is zero.
  std::vector<Eigen::Vector3d> ByVertex(const std::vector<Eigen::Vector3d>& points,
                                        const Eigen::Vector3d& origin) const {
    std::vector<Eigen::Vector3d> derivatives(points.size(), Eigen::Vector3d::Zero());
    for (const std::array<int, 3>& t : triangles_) {
      for (int corner = 0; corner < 3; ++corner) {
        const Eigen::Vector3d b = points[t[(corner + 1) % 3]] - origin;
        const Eigen::Vector3d c = points[t[(corner + 2) % 3]] - origin;
        derivatives[t[corner]] += b.cross(c) / (6.0 * volume_);
      }
    }
    return derivatives;
  }

  // Writes the Jacobians. Ceres passes a null pointer for each block that is held constant, so each
  // pointer is tested.
  void FillJacobians(const std::vector<Eigen::Vector3d>& by_vertex, double** jacobians) const {
    for (std::size_t b = 0; b < parameter_block_sizes().size(); ++b) {
      if (jacobians[b] != nullptr) std::fill_n(jacobians[b], kNodeSize, 0.0);
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const BoundPoint& bound = vertices_[v].bound;
      for (int i = 0; i < bound.num_nodes(); ++i) {
        double* jacobian = jacobians[vertices_[v].blocks[i]];
        if (jacobian == nullptr) continue;
        const Eigen::Vector3d by_translation = bound.weight(i) * by_vertex[v];
        MutableNodeAffine(jacobian) += by_translation * bound.offset(i).transpose();
        MutableNodeTranslation(jacobian) += by_translation;
      }
    }
  }

  std::vector<Vertex> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  double volume_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_VOLUME_COST_H_
