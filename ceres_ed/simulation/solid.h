// Smooth closed bodies as the zero set of one function: flattened tubes blended into each other.
#ifndef CERES_ED_SIMULATION_SOLID_H_
#define CERES_ED_SIMULATION_SOLID_H_

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A chain of balls swept into each other; one ball alone is an ellipsoid once it is flattened.
struct SolidTube {
  // Centre and radius of each control ball (x, y, z, r), unit of the solid; a spline runs through.
  std::vector<Eigen::Vector4d> balls;
  // The tube's thickness along `thin_axis` (unit vector) is `flatness` in (0, 1] times its width.
  Eigen::Vector3d thin_axis = Eigen::Vector3d::UnitY();
  double flatness = 1.0;
  // True to take the tube out of what was added before it.
  bool carve = false;
};

// Tubes blended in the order in which they were added.
class SyntheticSolid {
 public:
  // `blend` > 0 is the width of the fillet between two tubes, unit of the solid.
  explicit SyntheticSolid(double blend) : blend_(blend) {}

  // Appends a tube; at least one ball, positive radii.
  void Add(const SolidTube& tube);

  // Returns the approximate signed distance of `point` to the surface, negative inside. Exact to
  // first order near the surface, away from fillets.
  double Value(const Eigen::Vector3d& point) const;

  // Returns the gradient of Value() by central differences.
  Eigen::Vector3d Gradient(const Eigen::Vector3d& point) const;

  // Returns the point of the surface that Newton's method reaches from `point` along the gradient.
  Eigen::Vector3d Project(const Eigen::Vector3d& point) const;

  // Returns the lower and the upper corner of a box that holds every tube.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> Bounds() const;

 private:
  struct Chain {
    // Centres in the stretched frame of the tube, radii beside them.
    std::vector<Eigen::Vector3d> centers;
    std::vector<double> radii;
    // How far each link between two balls reaches from the first one's centre.
    std::vector<double> reaches;
    Eigen::Vector3d thin_axis;
    // Stretch along the thin axis, 1 / flatness.
    double stretch;
    bool carve;
    // A ball around the tube in the frame of the solid, to skip it from afar.
    Eigen::Vector3d bound_center;
    double bound_radius;
  };
  double Distance(const Chain& chain, const Eigen::Vector3d& point) const;

  double blend_;
  std::vector<Chain> chains_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SOLID_H_
