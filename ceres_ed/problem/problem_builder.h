// Turns energies into Ceres problems: the full one, or any part of it.
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

// A ceres::Problem over the blocks of one DeformationState, with the losses that it uses. The cost
// functions of energies that came as such stay with the builder: it and the state must outlive
// this, and the state must not be resized.
struct BuiltProblem {
  // Declared ahead of the problem, which refers to them.
  std::vector<std::shared_ptr<const ceres::CostFunction>> costs;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses;
  std::unique_ptr<ceres::Manifold> rotation_manifold;
  std::unique_ptr<ceres::Problem> problem;
  int num_variable_nodes = 0;
  bool camera_variable = false;
};

// One residual block of a subproblem; what it points to belongs to the builder, or to the config
// where it is one of its extra residuals.
struct SelectedResidual {
  // Null where it is residual `index` of `store`.
  const ceres::CostFunction* cost = nullptr;
  const ResidualStore* store = nullptr;
  int index = -1;
  const BlockRef* blocks = nullptr;
  int num_blocks = 0;
  // -1 for an extra residual.
  int term = -1;
  // Weight of the term times that of the residual.
  double weight = 1.0;

  int num_residuals() const;
  // `cost`, or one that is made of what the store has.
  std::shared_ptr<const ceres::CostFunction> CostFunction(const DeformationGraph& graph) const;
};

// Collects the residuals of energy terms once, and builds any number of Ceres problems from them.
// The graph must outlive the builder.
class ProblemBuilder {
 public:
  ProblemBuilder(const DeformationGraph& graph, bool has_camera);
  ~ProblemBuilder();
  ProblemBuilder(const ProblemBuilder&) = delete;
  ProblemBuilder& operator=(const ProblemBuilder&) = delete;

  const DeformationGraph& graph() const { return graph_; }
  bool has_camera() const { return has_camera_; }

  // Adds a term with no residuals yet and returns its index. `label` names it in summaries;
  // weight >= 0.
  int AddTerm(std::string label, EnergyKind kind, double weight = 1.0, const LossSpec& loss = {});

  // What messages about the term name beside its label (EnergyInfo::origin).
  void SetOrigin(int term, std::string origin);

  // Collects (or, after new correspondences, collects anew) the residuals of a term. An energy that
  // throws or adds a residual that doesn't fit (block sizes, a node or camera that isn't there, a
  // block twice, a weight that isn't finite and >= 0) leaves the term empty, and status() says why.
  void CollectResiduals(int term, const EnergyTerm& energy, const EnergyContext& context);

  // The first thing that went wrong when residuals were collected, with the energy's name: nothing
  // can be solved then.
  Status status() const;

  // The first residual that can't be used at `state`: it throws, it fails, it or a derivative of it
  // isn't finite. The sentence names energy, plugin, residual and its nodes. What a solver says
  // when it fails; as slow as ceres::Problem::Evaluate.
  Status CheckResiduals(const DeformationState& state) const;

  // Takes effect in problems that are built from now on.
  void SetWeight(int term, double weight);
  void SetLoss(int term, const LossSpec& loss);

  int num_terms() const { return static_cast<int>(terms_.size()); }
  const std::string& label(int term) const { return terms_[term].label; }
  double weight(int term) const { return terms_[term].weight; }
  const LossSpec& loss(int term) const { return terms_[term].loss; }
  // Residual blocks of a term.
  int NumResidualBlocks(int term) const;

  // One entry a node: nonzero where an observation residual of positive weight touches it (PR).
  std::vector<char> PointRelevantNodes() const;

  // The residuals that a problem of `config` has, in the order in which they were added, then the
  // extra ones: those of positive weight that touch something variable and nothing eliminated, less
  // the priors that kCut takes out at the seam. Looks at `config`, which must outlive the result.
  std::vector<SelectedResidual> Select(const ProblemConfig& config) const;
  // The same into a vector that is there.
  void Select(const ProblemConfig& config, std::vector<SelectedResidual>* selected) const;

  // The problem of `config` over the blocks of `state`. Blocks that residuals touch and that aren't
  // variable are constant.
  BuiltProblem Build(const ProblemConfig& config, DeformationState* state) const;

  // The costs of all residuals at `state`, whatever a config would leave out. A residual that can't
  // be evaluated makes its term's costs NaN, and so does a term that could not be collected.
  EnergySummary Evaluate(const DeformationState& state) const;

 private:
  // A residual block: where its function and its blocks stand in the term.
  struct Residual {
    // Null where it is in Term::costs.
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
    // Kept when residuals are collected anew, with their memory.
    struct NamedStore {
      ResidualStoreFactory factory = nullptr;
      std::unique_ptr<ResidualStore> store;
    };
    std::vector<NamedStore> stores;

    SelectedResidual Selected(const Residual& residual) const;
  };
  class TermSink;

  void CheckConfig(const ProblemConfig& config) const;
  TermEnergy Evaluate(const Term& term, const DeformationState& state) const;
  Status CheckResidual(const Term& term, int index, const DeformationState& state) const;

  const DeformationGraph& graph_;
  const bool has_camera_;
  std::vector<Term> terms_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_PROBLEM_BUILDER_H_
