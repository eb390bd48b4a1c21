// Populations of shapes with known modes of variation.
#ifndef CERES_ED_SIMULATION_SHAPE_FAMILY_H_
#define CERES_ED_SIMULATION_SHAPE_FAMILY_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct ShapeFamilyOptions {
  int shapes = 200;
  // The vertices of the template, about; >= 500.
  int vertices = 2600;
  // The length of the body, in the unit of the shapes.
  double size = 100.0;
  std::uint64_t seed = 1;
  // Whether the second half of the shapes has another mean: mode 0 is larger by two standard
  // deviations.
  bool groups = false;
};

// Dolphins that differ by three modes: x' = x + sum_k b_k u_k(x), with normally distributed b_k.
// The u_k bend the body to one side, bend it like an S, and lift the tail; lengths change little,
// so that the shapes show where each point has gone. Every shape has a mesh of its own and lies
// elsewhere.
class ShapeFamily {
 public:
  static constexpr int kModes = 3;
  using Amplitudes = std::array<double, kModes>;

  explicit ShapeFamily(const ShapeFamilyOptions& options);

  int size() const { return static_cast<int>(amplitudes_.size()); }
  // The mesh of all b_k = 0.
  const PointCloud& source() const { return source_; }
  // b_k of a shape, as parts of the body's length.
  const Amplitudes& amplitudes(int shape) const { return amplitudes_[shape]; }
  // Returns the mesh of a shape.
  PointCloud Shape(int shape) const;
  // Returns where the points of source() are on a shape.
  std::vector<Eigen::Vector3d> Truth(int shape) const;

 private:
  std::vector<Eigen::Vector3d> Deform(int shape, const std::vector<Eigen::Vector3d>& points) const;

  ShapeFamilyOptions options_;
  PointCloud source_;
  // Meshes of the body, which shapes take in turn.
  std::vector<PointCloud> meshes_;
  std::vector<Amplitudes> amplitudes_;
  std::vector<Similarity> poses_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SHAPE_FAMILY_H_
