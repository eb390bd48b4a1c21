// The interface of an energy: one physical term of the objective (for example rotation,
// regularization or point-to-plane).
//
// A term turns its input (EnergyContext) into Ceres cost functions and passes them to a sink. It
// does not apply its weight or a robust loss. The problem builder applies both, so that the same
// residuals give weighted and raw costs.
#ifndef CERES_ED_ENERGY_ENERGY_H_
#define CERES_ED_ENERGY_ENERGY_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

namespace ceres_ed {

// A point of the map and the position at which it was observed.
struct Correspondence {
  // The index of the point in EnergyContext::points.
  int point = -1;
  // The index of more data about the pair in EnergyContext::match_details; -1 if there are none.
  int detail = -1;
  // The observed position, in map units. It is in the camera frame if there is a camera, otherwise
  // in the map frame.
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // The unit normal of the target surface in the same frame; zero if it is unknown. (A fit uses the
  // mean of the normals of both surfaces.)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // The weight of this observation in the sum, >= 0, without a unit.
  double weight = 1.0;
};

// More data about a matched pair. Vectors are in the frame of Correspondence::target.
struct MatchDetail {
  // The unit normals of the two surfaces; zero if unknown. That of the source is taken from the
  // surface as it was warped when the pair was matched. The two may point to opposite sides if a
  // surface knows its normals only up to sign.
  Eigen::Vector3d source_normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_normal = Eigen::Vector3d::Zero();
  // The brightness of the point and of the target, in [0, 1]; NaN if unknown.
  double source_intensity = std::numeric_limits<double>::quiet_NaN();
  double target_intensity = std::numeric_limits<double>::quiet_NaN();
  // The gradient of the target's brightness along its tangent plane, per map unit; zero if
  // target_intensity is unknown.
  Eigen::Vector3d intensity_gradient = Eigen::Vector3d::Zero();

  // Returns whether the brightness of both is known.
  bool HasIntensities() const {
    return std::isfinite(source_intensity) && std::isfinite(target_intensity);
  }
};

// The kind of an energy. An observation makes the nodes that its residuals touch PR (point
// relevant); a prior does not.
enum class EnergyKind { kObservation, kPrior };

// The type of a parameter.
enum class ParameterType { kReal, kInteger, kFlag };

// A parameter of an energy, as users set it (`--energy=NAME:param=value`). Values are doubles. An
// integer has no fraction, and a flag is 0 or 1.
struct EnergyParameter {
  std::string name;
  ParameterType type = ParameterType::kReal;
  // The unit; "-" if there is none. Lengths are in map units. In ed_fit the unit is the diagonal of
  // the source.
  std::string unit = "-";
  // The allowed range, both ends included.
  double minimum = 0.0;
  double maximum = 0.0;
  double default_value = 0.0;
  // A description in one line.
  std::string doc;
};

// The following functions return a parameter of one type, for example
//   RealParameter("height", "length", -10.0, 10.0, 0.0, "where the floor is").
inline EnergyParameter RealParameter(std::string name,
                                     std::string unit,
                                     double minimum,
                                     double maximum,
                                     double default_value,
                                     std::string doc) {
  return {std::move(name),
          ParameterType::kReal,
          std::move(unit),
          minimum,
          maximum,
          default_value,
          std::move(doc)};
}
inline EnergyParameter IntegerParameter(
    std::string name, double minimum, double maximum, double default_value, std::string doc) {
  return {std::move(name),
          ParameterType::kInteger,
          "-",
          minimum,
          maximum,
          default_value,
          std::move(doc)};
}
inline EnergyParameter FlagParameter(std::string name, bool default_value, std::string doc) {
  return {std::move(name),
          ParameterType::kFlag,
          "-",
          0.0,
          1.0,
          default_value ? 1.0 : 0.0,
          std::move(doc)};
}

// The description of an energy in a registry.
struct EnergyInfo {
  std::string name;
  // What the energy aims at, in one line.
  std::string summary;
  // The residual as an equation, with its source ("Eq. 5").
  std::string equation;
  // The unit of the residual.
  std::string unit;
  EnergyKind kind = EnergyKind::kPrior;
  std::vector<EnergyParameter> parameters;
  // The plugin from which it was loaded ("plugin './mine.so'"); empty if there is none. The loader
  // sets it.
  std::string origin;
};

// Returns "energy 'mine' of plugin './mine.so'", with which a message about the energy begins.
inline std::string DescribeEnergy(const std::string& name, const std::string& origin) {
  return "energy '" + name + "'" + (origin.empty() ? "" : " of " + origin);
}

// A reference to a parameter block that a residual uses.
struct BlockRef {
  enum class Kind { kNode, kCameraRotation, kCameraTranslation };

  Kind kind = Kind::kNode;
  // The index of the node; -1 for the camera.
  int node = -1;

  static BlockRef Node(int node) { return {Kind::kNode, node}; }
  static BlockRef CameraRotation() { return {Kind::kCameraRotation, -1}; }
  static BlockRef CameraTranslation() { return {Kind::kCameraTranslation, -1}; }
};

// Returns the parameter block of `state` to which `block` refers.
inline const double* BlockPointer(const DeformationState& state, const BlockRef& block) {
  switch (block.kind) {
    case BlockRef::Kind::kCameraRotation:
      return state.camera_from_map.rotation.coeffs().data();
    case BlockRef::Kind::kCameraTranslation:
      return state.camera_from_map.translation.data();
    case BlockRef::Kind::kNode:
      break;
  }
  return state.node(block.node);
}

// The input of an energy. Pointers are not null unless a comment says so; lists may be empty.
struct EnergyContext {
  const DeformationGraph* graph = nullptr;
  // The points at rest, in map units, and the nodes to which they are bound.
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const Skinning* skinning = nullptr;
  // The pairs found by matching. They change from iteration to iteration.
  const std::vector<Correspondence>* correspondences = nullptr;
  // More data about these pairs, indexed by Correspondence::detail; null if matching was not asked
  // for them.
  const std::vector<MatchDetail>* match_details = nullptr;
  // The pairs given by the user (landmarks, pinned points). They do not change.
  const std::vector<Correspondence>* landmarks = nullptr;
  // True if warped points are taken into the camera frame (Eq. 1 with R_c, T_c).
  bool has_camera = false;
  // The expected camera pose before the solve.
  CameraPose camera_prior;
  // The expected t_j of each node before the solve; null if nothing is known.
  const std::vector<Eigen::Vector3d>* node_prior = nullptr;
  // The t_j of each node one frame ago; null if there was none, as in a fit.
  const std::vector<Eigen::Vector3d>* node_previous = nullptr;
  // The unit normals of `points` at rest, zero where unknown; null if there are none.
  const std::vector<Eigen::Vector3d>* normals = nullptr;
  // The triangles over `points`, counter-clockwise as seen from outside; null if there are none.
  const std::vector<std::array<int, 3>>* triangles = nullptr;
};

// Residuals in arrays, see residual_store.h.
class ResidualStore;
// A function that makes an empty store.
using ResidualStoreFactory = std::unique_ptr<ResidualStore> (*)();

// The receiver of an energy's residuals.
class ResidualSink {
 public:
  virtual ~ResidualSink() = default;

  // Adds a residual. `blocks` are in the order of the cost function's parameter blocks. `weight` >=
  // 0 is a factor of this residual's (robust) cost, in addition to the weight of its energy.
  virtual void Add(std::unique_ptr<ceres::CostFunction> cost,
                   const BlockRef* blocks,
                   int num_blocks,
                   double weight = 1.0) = 0;

  // The two functions below are needed only for residuals of a new form; point_energy.h and
  // residual_store.h call them for you.
  //
  // Returns this sink's store of the kind that `make` creates. It is created at the first call.
  // Returns null if the sink takes only cost functions.
  virtual ResidualStore* FindStore(ResidualStoreFactory /*make*/) { return nullptr; }
  // Adds the residual that was added to `store` last.
  virtual void AddStored(const ResidualStore* /*store*/,
                         const BlockRef* /*blocks*/,
                         int /*num_blocks*/,
                         double /*weight*/) {}
};

// One term of the objective, with the values of its parameters.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;

  virtual EnergyKind kind() const = 0;

  // Adds all residuals of this term for `context`. May be called any number of times.
  virtual void AddResiduals(const EnergyContext& context, ResidualSink* sink) const = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_H_
