// What an energy is: one physical term of the objective (rotation, regularization, point-to-plane).
//
// A term turns what is known (EnergyContext) into Ceres cost functions and hands them to a sink. It
// never weighs them and never makes them robust: that is the problem builder's part, so that the
// same residuals yield weighted and raw costs.
#ifndef CERES_ED_ENERGY_ENERGY_H_
#define CERES_ED_ENERGY_ENERGY_H_

#include <ceres_ed/energy/correspondence.h>
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

// An observation makes the nodes that its residuals touch PR (point relevant); a prior doesn't.
enum class EnergyKind { kObservation, kPrior };

enum class ParameterType { kReal, kInteger, kFlag };

// A parameter of an energy, as users set it (`--energy=NAME:param=value`). Values are doubles; an
// integer has no fraction and a flag is 0 or 1.
struct EnergyParameter {
  std::string name;
  ParameterType type = ParameterType::kReal;
  // "-" where it has none. Lengths are in map units, in ed_fit source diagonals.
  std::string unit = "-";
  double minimum = 0.0;
  double maximum = 0.0;
  double default_value = 0.0;
  // One line.
  std::string doc;
};

// Parameters in a line: RealParameter("height", "length", -10.0, 10.0, 0.0, "where the floor is").
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

// What a registry says of an energy.
struct EnergyInfo {
  std::string name;
  // One line; what the energy wants.
  std::string summary;
  // The residual, with its source ("Eq. 5").
  std::string equation;
  // Unit of the residual.
  std::string unit;
  EnergyKind kind = EnergyKind::kPrior;
  std::vector<EnergyParameter> parameters;
  // The plugin that it came with ("plugin './mine.so'"); empty for others. Set by the loader.
  std::string origin;
};

// Returns "energy 'mine' of plugin './mine.so'": what a message about it begins with.
inline std::string DescribeEnergy(const std::string& name, const std::string& origin) {
  return "energy '" + name + "'" + (origin.empty() ? "" : " of " + origin);
}

// A parameter block that a residual touches.
struct BlockRef {
  enum class Kind { kNode, kCameraRotation, kCameraTranslation };

  Kind kind = Kind::kNode;
  // Node index; -1 for the camera.
  int node = -1;

  static BlockRef Node(int node) { return {Kind::kNode, node}; }
  static BlockRef CameraRotation() { return {Kind::kCameraRotation, -1}; }
  static BlockRef CameraTranslation() { return {Kind::kCameraTranslation, -1}; }
};

// The parameter block of `state` that `block` names.
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

// What energies may look at. Pointers are never null unless said so; lists may be empty.
struct EnergyContext {
  const DeformationGraph* graph = nullptr;
  // Points at rest, map units, and the nodes that carry them.
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const Skinning* skinning = nullptr;
  // Found by matching; changes from iteration to iteration.
  const std::vector<Correspondence>* correspondences = nullptr;
  // More of them, by Correspondence::detail; null where matching wasn't asked for it.
  const std::vector<MatchDetail>* match_details = nullptr;
  // Given by the user (landmarks, pinned points); stays.
  const std::vector<Correspondence>* landmarks = nullptr;
  // Whether warped points go on into a camera frame (Eq. 1 with R_c, T_c).
  bool has_camera = false;
  // Where the camera is thought to be before the solve.
  CameraPose camera_prior;
  // t_j where each node is thought to be before the solve, one a node; null where nothing is known.
  const std::vector<Eigen::Vector3d>* node_prior = nullptr;
  // t_j of each node one frame ago; null where there was none, as in a fit.
  const std::vector<Eigen::Vector3d>* node_previous = nullptr;
  // Faces over `points`, counter-clockwise seen from outside; null where there are none.
  const std::vector<std::array<int, 3>>* triangles = nullptr;
};

// Residuals in arrays (residual_store.h).
class ResidualStore;
using ResidualStoreFactory = std::unique_ptr<ResidualStore> (*)();

// Where an energy puts its residuals.
class ResidualSink {
 public:
  virtual ~ResidualSink() = default;

  // `blocks` in the order of the cost function's parameter blocks. `weight` >= 0 multiplies this
  // residual's (robust) cost on top of the weight of its energy.
  virtual void Add(std::unique_ptr<ceres::CostFunction> cost,
                   const BlockRef* blocks,
                   int num_blocks,
                   double weight = 1.0) = 0;

  // For those who write residuals of a new form (point_energy.h and residual_store.h do the rest):
  // this sink's store that `make` makes, made when it is first asked for; null where the sink takes
  // cost functions alone.
  virtual ResidualStore* FindStore(ResidualStoreFactory /*make*/) { return nullptr; }
  // Adds the residual that was last added to `store`.
  virtual void AddStored(const ResidualStore* /*store*/,
                         const BlockRef* /*blocks*/,
                         int /*num_blocks*/,
                         double /*weight*/) {}
};

// One term of the objective, with its parameters set.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;

  virtual EnergyKind kind() const = 0;

  // Adds all residuals of this term for `context`. Callable any number of times.
  virtual void AddResiduals(const EnergyContext& context, ResidualSink* sink) const = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_H_
