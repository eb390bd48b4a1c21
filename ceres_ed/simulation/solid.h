// Smooth closed bodies, given as the zero set of one function: flattened tubes that are blended
// into each other.
#ifndef CERES_ED_SIMULATION_SOLID_H_
#define CERES_ED_SIMULATION_SOLID_H_

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A tube: the volume that a chain of balls sweeps. A single ball becomes an ellipsoid when it is
// flattened.
struct SolidTube {
  // Centre and radius of each control ball (x, y, z, r) in the unit of the solid; a spline passes
  // through them.
  std::vector<Eigen::Vector4d> balls;
  // The thickness of the tube along `thin_axis` (a unit vector) is `flatness` in (0, 1] times its
  // width.
  Eigen::Vector3d thin_axis = Eigen::Vector3d::UnitY();
  double flatness = 1.0;
  // Whether the tube is removed from the body that was added before it.
  bool carve = false;
};

// A body of tubes, which are blended in the order in which they were added.
class SyntheticSolid {
 public:
  // `blend` > 0 is the width of the fillet between two tubes, in the unit of the solid.
  explicit SyntheticSolid(double blend) : blend_(blend) {}

  // Appends a tube, which must have at least one ball, and positive radii.
  void Add(const SolidTube& tube);

  // Returns the approximate signed distance of `point` to the surface, which is negative inside. It
  // is exact to first order near the surface, away from fillets.
  double Value(const Eigen::Vector3d& point) const;

  // Returns the gradient of Value() by central differences.
  Eigen::Vector3d Gradient(const Eigen::Vector3d& point) const;

  // Returns the surface point that Newton's method reaches from `point` along the gradient.
  Eigen::Vector3d Project(const Eigen::Vector3d& point) const;

  // Returns the lower and the upper corner of a box that contains every tube.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> Bounds() const;

 private:
  struct Chain {
    // The centres in the stretched frame of the tube, and the radii.
    std::vector<Eigen::Vector3d> centers;
    std::vector<double> radii;
    // For each link between two balls, how far it reaches from the centre of the first one.
    std::vector<double> reaches;
    Eigen::Vector3d thin_axis;
    // The stretch along the thin axis, 1 / flatness.
    double stretch;
    bool carve;
    // A ball around the tube in the frame of the solid, by which distant tubes are skipped.
    Eigen::Vector3d bound_center;
    double bound_radius;
  };
  double Distance(const Chain& chain, const Eigen::Vector3d& point) const;

  double blend_;
  std::vector<Chain> chains_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_SOLID_H_
