// The energies of the user in a finish.
#ifndef CERES_ED_REGISTRATION_FINISH_OWN_ENERGIES_H_
#define CERES_ED_REGISTRATION_FINISH_OWN_ENERGIES_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/welded_mesh.h>
#include <ceres_ed/problem/point_batches.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/registration/unit_fit.h>

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Evaluates energies on vertices that move by themselves: each vertex is a node with A_j = I to
// which its points are bound alone, so that a warped point is the vertex. Residuals that depend on
// an A_j say something about nodes and are left out; so are those of matched pairs, because the
// finish has pairs of its own.
class OwnEnergies {
 public:
  // Takes the energies of `fit.options`, with weights in the unit of the finish, in which the pairs
  // of a vertex weigh about 1. Returns null if none of them says something about vertices. The
  // arguments must outlive the result.
  static std::unique_ptr<OwnEnergies> Create(const UnitFit& fit, const WeldedMesh& mesh);

  // Adds half the gradient of the energies at the vertices `points` to `gradient` (a row a vertex).
  // Returns a weight for each vertex: the diagonal matrix of these majorises the Gauss-Newton
  // matrices here and at all points of earlier calls, because for a residual with derivatives J_i
  //   |sum_i J_i d_i|^2 <= sum_i |J_i| (sum_k |J_k|) |d_i|^2.
  // (A wall that has been met once then holds, also when it is not touched.) A residual that cannot
  // be evaluated is left out.
  const Eigen::VectorXd& Add(const std::vector<Eigen::Vector3d>& points, Eigen::MatrixXd* gradient);

 private:
  OwnEnergies() = default;
  void AddEnergy(const UnitFit& fit, const EnergySpec& spec, const EnergyContext& context);
  // Turns A_j of each vertex as its normal has turned since the start, for functions that look at
  // normals. The warped points do not depend on A_j.
  void TurnNormals(const std::vector<Eigen::Vector3d>& points);

  // The vertices at rest as nodes, and the binding of the points of the source.
  DeformationGraph graph_;
  Skinning skinning_{1};
  DeformationState state_;
  std::vector<Correspondence> none_;
  // The residuals may refer to these.
  std::vector<std::unique_ptr<EnergyTerm>> energies_;
  std::unique_ptr<ProblemBuilder> builder_;
  std::vector<SelectedResidual> residuals_;
  std::vector<std::shared_ptr<const ceres::CostFunction>> costs_;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;
  // The residuals that are evaluated all at once; costs_ has none for them.
  PointBatches batches_;
  const WeldedMesh* mesh_ = nullptr;
  std::vector<Eigen::Vector3d> normals_at_rest_;
  Eigen::VectorXd weights_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_OWN_ENERGIES_H_
