#include "ceres_ed/testing/energy_laws.h"

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <ceres/autodiff_cost_function.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The residual gain * t_j.
struct AnchorCost {
  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = T(gain) * node[kNodeTranslationOffset + i];
    return true;
  }
  double gain;
};

std::unique_ptr<ceres::CostFunction> MakeAnchor(double gain) {
  return std::make_unique<ceres::AutoDiffCostFunction<AnchorCost, 3, kNodeSize>>(
      new AnchorCost{gain});
}

using AddFunction = std::function<void(const EnergyContext&, ResidualSink*)>;

class FunctionEnergy final : public EnergyTerm {
 public:
  FunctionEnergy(EnergyKind kind, AddFunction add) : kind_(kind), add_(std::move(add)) {}
  EnergyKind kind() const override { return kind_; }
  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    add_(context, sink);
  }

 private:
  EnergyKind kind_;
  AddFunction add_;
};

EnergyInfo AnchorInfo() {
  return {"anchor",
          "pulls nodes home",
          "gain t_j",
          "length",
          EnergyKind::kPrior,
          {{"gain", ParameterType::kReal, "-", 0.0, 10.0, 2.0, "factor of the residual"}},
          ""};
}

void AddAnchors(const EnergyContext& context, ResidualSink* sink) {
  for (int j = 0; j < context.graph->num_nodes(); ++j) {
    const BlockRef block = BlockRef::Node(j);
    sink->Add(MakeAnchor(2.0), &block, 1);
  }
}

std::vector<std::string> Check(const EnergyInfo& info,
                               const AddFunction& add,
                               const EnergyClaims& claims = {}) {
  EnergyRegistry registry;
  const EnergyKind kind = EnergyKind::kPrior;
  EXPECT_TRUE(registry
                  .Register(info,
                            [=](const ParameterValues& values) {
                              for (const EnergyParameter& p : info.parameters) values.Get(p.name);
                              return std::make_unique<FunctionEnergy>(kind, add);
                            })
                  .ok());
  return CheckEnergyLaws(registry, info.name, claims);
}

TEST(CheckEnergyLaws, FindsNothingWrongWithARightEnergy) {
  EXPECT_THAT(Check(AnchorInfo(), AddAnchors), IsEmpty());
}

TEST(CheckEnergyLaws, FindsAnEnergyThatIsNotThere) {
  EXPECT_THAT(CheckEnergyLaws(EnergyRegistry(), "ghost"),
              Contains(HasSubstr("energy 'ghost': there is no energy of this name")));
}

TEST(CheckEnergyLaws, FindsAnIncompleteDescription) {
  EnergyInfo info = AnchorInfo();
  info.summary.clear();
  info.unit.clear();
  info.parameters[0].doc.clear();
  const std::vector<std::string> violations = Check(info, AddAnchors);
  EXPECT_THAT(violations, Contains(HasSubstr("no summary")));
  EXPECT_THAT(violations, Contains(HasSubstr("no unit")));
  EXPECT_THAT(violations, Contains(HasSubstr("parameter 'gain' has no doc")));
}

TEST(CheckEnergyLaws, FindsAnEnergyOfAnotherKind) {
  EnergyInfo info = AnchorInfo();
  info.kind = EnergyKind::kObservation;
  EXPECT_THAT(Check(info, AddAnchors),
              Contains(HasSubstr("its term is not of the kind that it is registered as")));
}

TEST(CheckEnergyLaws, FindsAnEnergyThatAddsNothing) {
  EXPECT_THAT(Check(AnchorInfo(), [](const EnergyContext&, ResidualSink*) {}),
              Contains(HasSubstr("adds no residuals")));
}

TEST(CheckEnergyLaws, FindsBlocksThatAreNotThere) {
  const auto add_one = [](const std::vector<BlockRef>& blocks) {
    return [=](const EnergyContext&, ResidualSink* sink) {
      sink->Add(MakeAnchor(1.0), blocks.data(), static_cast<int>(blocks.size()));
    };
  };
  EXPECT_THAT(Check(AnchorInfo(), add_one({BlockRef::Node(18)})),
              Contains(HasSubstr("block 0 is node 18 of 18")));
  EXPECT_THAT(Check(AnchorInfo(), add_one({})), Contains(HasSubstr("neither a node nor")));
  EXPECT_THAT(Check(AnchorInfo(), add_one({BlockRef::Node(1), BlockRef::Node(2)})),
              Contains(HasSubstr("it has 2 blocks, its cost function 1")));
  const std::vector<std::string> camera =
      Check(AnchorInfo(), add_one({BlockRef::CameraRotation()}));
  EXPECT_THAT(camera, Contains(HasSubstr("without a camera, residual 0: block 0 is a camera")));
  EXPECT_THAT(camera, Contains(HasSubstr("with a camera, residual 0: block 0 has size 12")));
}

TEST(CheckEnergyLaws, FindsAnEnergyThatChangesItsMind) {
  auto calls = std::make_shared<int>(0);
  const std::vector<std::string> violations =
      Check(AnchorInfo(), [calls](const EnergyContext&, ResidualSink* sink) {
        const BlockRef block = BlockRef::Node(0);
        sink->Add(MakeAnchor(1.0 + 1e-12 * ++*calls), &block, 1);
      });
  EXPECT_THAT(violations, Contains(HasSubstr("asked twice it adds another residual 0")));
}

TEST(CheckEnergyLaws, FindsACostThatBreaksALaw) {
  const std::vector<std::string> violations =
      Check(AnchorInfo(), [](const EnergyContext& context, ResidualSink* sink) {
        const BlockRef block = BlockRef::Node(0);
        const double gain = context.correspondences->empty() ? std::nan("") : 1.0;
        sink->Add(MakeAnchor(gain), &block, 1);
      });
  EXPECT_THAT(violations, Contains(HasSubstr("values are not finite with empty lists")));
}

TEST(CheckEnergyLaws, FindsAnInvarianceThatDoesNotHold) {
  EnergyClaims claims;
  claims.invariances.push_back(
      {"a common translation", [](const DeformationGraph& graph, DeformationState* state) {
         for (int j = 0; j < graph.num_nodes(); ++j) {
           state->node(j)[kNodeTranslationOffset] += 1.0;
         }
       }});
  EXPECT_THAT(Check(AnchorInfo(), AddAnchors, claims),
              Contains(HasSubstr("under a common translation")));
}

TEST(MakeTestProblem, HasTheStatedEdgesAndBindings) {
  TestProblemOptions options;
  options.columns = 5;
  options.rows = 4;
  options.points_per_cell = 2;
  options.observed_columns = 1;
  const TestProblem problem = MakeTestProblem(options);
  EXPECT_EQ(problem.graph.num_nodes(), 20);
  EXPECT_EQ(problem.graph.num_edges(), 2 * 4 * 4 + 2 * 5 * 3);
  ASSERT_EQ(problem.points.size(), 2u * 4 * 3);
  EXPECT_EQ(problem.correspondences.size(), 2u * 1 * 3);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const Binding binding = problem.skinning[p];
    double sum = 0.0;
    for (int i = 0; i < binding.size; ++i) {
      EXPECT_GT(binding.weights[i], 0.0);
      sum += binding.weights[i];
      const Eigen::Vector3d offset = problem.points[p] - problem.graph.position(binding.nodes[i]);
      EXPECT_LT(offset.head<2>().cwiseAbs().maxCoeff(), 1.0);
    }
    EXPECT_EQ(binding.size, 4);
    EXPECT_NEAR(sum, 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace ceres_ed
