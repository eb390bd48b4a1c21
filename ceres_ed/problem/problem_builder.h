// Builds Ceres problems from energies: the full problem, or any part of it.
#ifndef CERES_ED_PROBLEM_PROBLEM_BUILDER_H_
#define CERES_ED_PROBLEM_PROBLEM_BUILDER_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/energy/residual_store.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>

namespace ceres_ed {

// A ceres::Problem over the blocks of one DeformationState, with the losses that it uses. Cost
// functions that energies added as such stay with the builder. Therefore the builder and the state
// must outlive this object, and the state must not be resized.
struct BuiltProblem {
  // These are declared before the problem, which refers to them, so that they are destroyed after
  // it.
  std::vector<std::shared_ptr<const ceres::CostFunction>> costs;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses;
  std::unique_ptr<ceres::Manifold> rotation_manifold;
  std::unique_ptr<ceres::Problem> problem;
  int num_variable_nodes = 0;
  bool camera_variable = false;
};

// One residual block of a subproblem. The objects to which it points belong to the builder, or to
// the config if it is one of its extra residuals.
struct SelectedResidual {
  // Null if it is residual `index` of `store`.
  const ceres::CostFunction* cost = nullptr;
  const ResidualStore* store = nullptr;
  int index = -1;
  const BlockRef* blocks = nullptr;
  int num_blocks = 0;
  // The index of its term; -1 for an extra residual.
  int term = -1;
  // The weight of the term times the weight of the residual.
  double weight = 1.0;

  int num_residuals() const;
  // Returns `cost`, or a new cost function made from the store.
  std::shared_ptr<const ceres::CostFunction> CostFunction(const DeformationGraph& graph) const;
};

// Collects the residuals of energy terms once, and builds any number of Ceres problems from them.
// The graph must outlive the builder.
class ProblemBuilder {
 public:
  // `has_camera` says whether residuals may use the camera.
  ProblemBuilder(const DeformationGraph& graph, bool has_camera);
  ~ProblemBuilder();
  ProblemBuilder(const ProblemBuilder&) = delete;
  ProblemBuilder& operator=(const ProblemBuilder&) = delete;

  const DeformationGraph& graph() const { return graph_; }
  bool has_camera() const { return has_camera_; }

  // Adds a term without residuals and returns its index. `label` names it in summaries. The weight
  // must be finite and >= 0.
  int AddTerm(std::string label, EnergyKind kind, double weight = 1.0, const LossSpec& loss = {});

  // Sets the origin of a term (EnergyInfo::origin), which messages name together with its label.
  void SetOrigin(int term, std::string origin);

  // Collects the residuals of a term; call it again after new correspondences. If the energy
  // throws, or adds a residual that does not fit (wrong block sizes, a node or camera that does not
  // exist, a block twice, a weight that is not finite and >= 0), the term is empty and status()
  // gives the reason.
  void CollectResiduals(int term, const EnergyTerm& energy, const EnergyContext& context);

  // Returns the first error that occurred while residuals were collected, with the name of the
  // energy. If there is one, no problem can be solved.
  Status status() const;

  // Returns an error for the first residual that can't be used at `state`: it throws, it fails, or
  // it or one of its derivatives is not finite. The sentence names energy, plugin, residual and
  // nodes. A solver calls this when it fails. It takes as long as ceres::Problem::Evaluate.
  Status CheckResiduals(const DeformationState& state) const;

  // The following two functions change the weight (finite, >= 0) or the loss of a term in all
  // problems that are built from now on.
  void SetWeight(int term, double weight);
  void SetLoss(int term, const LossSpec& loss);

  int num_terms() const { return static_cast<int>(terms_.size()); }
  const std::string& label(int term) const { return terms_[term].label; }
  double weight(int term) const { return terms_[term].weight; }
  const LossSpec& loss(int term) const { return terms_[term].loss; }
  // Returns the number of residual blocks of a term.
  int NumResidualBlocks(int term) const;

  // Returns one entry for each node: nonzero if it is PR (point relevant), which means that an
  // observation residual of positive weight touches it.
  std::vector<char> PointRelevantNodes() const;

  // Returns the residuals of the problem of `config`: those of positive weight that touch something
  // variable and no eliminated node, without the priors that kCut removes at the boundary. They are
  // in the order in which they were added; the extra residuals come last. The result refers to
  // `config`, which must outlive it.
  std::vector<SelectedResidual> Select(const ProblemConfig& config) const;
  // Does the same and reuses the memory of `selected`.
  void Select(const ProblemConfig& config, std::vector<SelectedResidual>* selected) const;

  // Returns the problem of `config` over the blocks of `state`. Blocks that residuals touch and
  // that are not variable are set constant.
  BuiltProblem Build(const ProblemConfig& config, DeformationState* state) const;

  // Returns the costs of all residuals at `state`, including those that a config would leave out.
  // The costs of a term are NaN if one of its residuals can't be evaluated or if the term could not
  // be collected.
  EnergySummary Evaluate(const DeformationState& state) const;

 private:
  // A residual block: the indices of its cost function and of its blocks in the term.
  struct Residual {
    // Null if its cost function is in Term::costs.
    const ResidualStore* store = nullptr;
    int index = 0;
    double weight = 1.0;
    int first_block = 0;
    int num_blocks = 0;
  };
  struct Term {
    std::string label;
    std::string origin;
    Status status = Status::Ok();
    EnergyKind kind = EnergyKind::kPrior;
    double weight = 1.0;
    LossSpec loss;
    std::vector<Residual> residuals;
    std::vector<BlockRef> blocks;
    std::vector<std::unique_ptr<ceres::CostFunction>> costs;
    // The stores are kept, with their memory, when residuals are collected again.
    struct NamedStore {
      ResidualStoreFactory factory = nullptr;
      std::unique_ptr<ResidualStore> store;
    };
    std::vector<NamedStore> stores;

    SelectedResidual Selected(const Residual& residual) const;
  };
  class TermSink;

  void CheckConfig(const ProblemConfig& config) const;
  // Returns whether the residuals of a term are evaluated all at once. They all are, or none.
  static bool IsBatch(const Term& term);
  TermEnergy Evaluate(const Term& term, const DeformationState& state) const;
  Status CheckResidual(const Term& term, int index, const DeformationState& state) const;

  const DeformationGraph& graph_;
  const bool has_camera_;
  std::vector<Term> terms_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_PROBLEM_BUILDER_H_
