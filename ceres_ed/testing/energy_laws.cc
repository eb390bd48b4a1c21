#include "ceres_ed/testing/energy_laws.h"

#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/energy_info_laws.h>
#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

bool SameBlocks(const std::vector<BlockRef>& a, const std::vector<BlockRef>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const BlockRef& x, const BlockRef& y) {
        return x.kind == y.kind && x.node == y.node;
      });
}

// Returns a step such that every `step`-th of `count` elements is at most `limit` elements.
int Stride(std::size_t count, int limit) {
  return std::max(1, static_cast<int>((count + limit - 1) / limit));
}

class EnergyLawChecker {
 public:
  EnergyLawChecker(const EnergyRegistry& registry, std::string name, const EnergyClaims& claims)
      : registry_(registry), name_(std::move(name)), claims_(claims) {}

  std::vector<std::string> Run() {
    info_ = registry_.Find(name_);
    if (info_ == nullptr) {
      Report("there is no energy of this name");
      return violations_;
    }
    for (const std::string& violation :
         CheckEnergyInfoLaws(registry_, *info_, claims_.parameters)) {
      Report(violation);
    }
    StatusOr<std::unique_ptr<EnergyTerm>> energy = registry_.Create(name_, claims_.parameters);
    if (!energy.ok()) {
      Report("it cannot be created: ", energy.status().message());
      return violations_;
    }
    energy_ = *std::move(energy);
    CheckContexts();
    return violations_;
  }

 private:
  template <typename... Parts>
  void Report(const Parts&... parts) {
    std::ostringstream sentence;
    sentence << "energy '" << name_ << "': ";
    (sentence << ... << parts);
    violations_.push_back(sentence.str());
  }

  void CheckContexts() {
    bool adds_any = false;
    for (const bool has_camera : {false, true}) {
      TestProblemOptions options = claims_.problem;
      options.has_camera = has_camera;
      options.target_deviation = 0.0;
      const TestProblem at_rest = MakeTestProblem(options);
      options.target_deviation = 0.3;
      const TestProblem off = MakeTestProblem(options);
      place_ = has_camera ? "with a camera" : "without a camera";
      adds_any = CheckProblem(at_rest, claims_.squared_norm_at_rest) || adds_any;
      CheckProblem(off, std::nullopt);
      CheckInvariances(off);
      CheckDegenerate(off);
    }
    if (!adds_any) Report("it adds no residuals, with a camera or without one");
  }

  // Checks the residuals of one problem. Returns true if residuals were added.
  bool CheckProblem(const TestProblem& problem, std::optional<double> squared_norm_at_rest) {
    const std::vector<CollectedResidual> residuals = CollectResiduals(*energy_, problem.Context());
    if (!CheckBlocks(problem, residuals)) return true;
    CheckTwice(problem, residuals);
    const int stride = Stride(residuals.size(), claims_.max_residuals);
    for (std::size_t i = 0; i < residuals.size(); i += stride) {
      CheckCost(problem, residuals[i], i, squared_norm_at_rest);
    }
    return !residuals.empty();
  }

  bool CheckBlocks(const TestProblem& problem, const std::vector<CollectedResidual>& residuals) {
    const std::size_t before = violations_.size();
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const std::string fault =
          BlockFault(residuals[i], problem.graph.num_nodes(), problem.has_camera);
      if (!fault.empty()) Report(place_, ", residual ", i, ": ", fault);
    }
    return violations_.size() == before;
  }

  void CheckTwice(const TestProblem& problem, const std::vector<CollectedResidual>& first) {
    const std::vector<CollectedResidual> second = CollectResiduals(*energy_, problem.Context());
    if (first.size() != second.size()) {
      Report(place_, ": asked twice it adds ", first.size(), " and ", second.size(), " residuals");
      return;
    }
    const DeformationState state = RandomState(problem, 0.3, claims_.cost.seed);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const std::vector<char> all(first[i].blocks.size(), 1);
      if (SameBlocks(first[i].blocks, second[i].blocks) && first[i].weight == second[i].weight &&
          EqualToTheBit(EvaluateCost(*first[i].cost, BlocksAt(first[i], state), all),
                        EvaluateCost(*second[i].cost, BlocksAt(second[i], state), all))) {
        continue;
      }
      Report(place_, ": asked twice it adds another residual ", i);
      return;
    }
  }

  void CheckCost(const TestProblem& problem,
                 const CollectedResidual& residual,
                 std::size_t index,
                 std::optional<double> squared_norm_at_rest) {
    CostClaims claims;
    claims.rest = BlocksAt(residual, DeformationState(problem.graph.num_nodes()));
    claims.squared_norm_at_rest = squared_norm_at_rest;
    claims.normalize = [&](ParameterBlocks* blocks) {
      for (std::size_t b = 0; b < blocks->size(); ++b) {
        if (residual.blocks[b].kind != BlockRef::Kind::kCameraRotation) continue;
        Eigen::Map<Eigen::Vector4d>((*blocks)[b].data()).normalize();
      }
    };
    for (const std::string& violation : CheckCostLaws(*residual.cost, claims, claims_.cost)) {
      Report(place_, ", residual ", index, ": ", violation);
    }
  }

  static double SumOfSquares(const std::vector<CollectedResidual>& residuals,
                             const DeformationState& state) {
    double sum = 0.0;
    for (const CollectedResidual& residual : residuals) {
      sum += EvaluateResiduals(*residual.cost, BlocksAt(residual, state)).residuals.squaredNorm();
    }
    return sum;
  }

  void CheckInvariances(const TestProblem& problem) {
    const std::vector<CollectedResidual> residuals = CollectResiduals(*energy_, problem.Context());
    for (const EnergyInvariance& invariance : claims_.invariances) {
      for (const double deviation : {0.0, 0.01, 0.5}) {
        DeformationState state = RandomState(problem, deviation, claims_.cost.seed);
        const double before = SumOfSquares(residuals, state);
        invariance.motion(problem.graph, &state);
        const double after = SumOfSquares(residuals, state);
        const double slack = claims_.cost.invariance_tolerance * std::max(1.0, before);
        if (std::abs(after - before) <= slack) continue;
        Report(place_,
               ": the energy changes from ",
               before,
               " to ",
               after,
               " under ",
               invariance.name);
      }
    }
  }

  void CheckFinite(const TestProblem& problem, const char* what) {
    const std::vector<CollectedResidual> residuals = CollectResiduals(*energy_, problem.Context());
    if (!CheckBlocks(problem, residuals)) return;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      for (const double deviation : {0.0, 0.5}) {
        const DeformationState state = RandomState(problem, deviation, claims_.cost.seed);
        const std::vector<char> all(residuals[i].blocks.size(), 1);
        if (EvaluateCost(*residuals[i].cost, BlocksAt(residuals[i], state), all).IsFinite()) {
          continue;
        }
        Report(place_, ", residual ", i, ": values are not finite with ", what);
        return;
      }
    }
  }

  void CheckDegenerate(const TestProblem& problem) {
    TestProblem changed = problem;
    for (Correspondence& c : changed.correspondences) c.normal.setZero();
    for (Correspondence& c : changed.landmarks) c.normal.setZero();
    for (MatchDetail& detail : changed.match_details) {
      detail.source_normal.setZero();
      detail.target_normal.setZero();
    }
    CheckFinite(changed, "zero normals");
    changed = problem;
    for (Correspondence& c : changed.correspondences) c.target.setConstant(1e6);
    for (Correspondence& c : changed.landmarks) c.target.setConstant(1e6);
    CheckFinite(changed, "targets far away");
    changed = problem;
    changed.graph = DeformationGraph();
    for (int j = 0; j < problem.graph.num_nodes(); ++j) {
      changed.graph.AddNode(problem.graph.position(0));
    }
    for (const GraphEdge& edge : problem.graph.edges()) changed.graph.AddEdge(edge);
    CheckFinite(changed, "all nodes at one place");
    changed = problem;
    for (Correspondence& c : changed.correspondences) c.detail = -1;
    CheckFinite(changed, "nothing more known of matched pairs");
    changed = problem;
    changed.correspondences.clear();
    changed.landmarks.clear();
    CheckFinite(changed, "empty lists");
  }

  const EnergyRegistry& registry_;
  const std::string name_;
  const EnergyClaims& claims_;
  const EnergyInfo* info_ = nullptr;
  std::unique_ptr<EnergyTerm> energy_;
  // "with a camera" or "without a camera".
  std::string place_;
  std::vector<std::string> violations_;
};

}  // namespace

std::vector<std::string> CheckEnergyLaws(const EnergyRegistry& registry,
                                         const std::string& name,
                                         const EnergyClaims& claims) {
  return EnergyLawChecker(registry, name, claims).Run();
}

}  // namespace ceres_ed
