#include "ceres_ed/energy/energy_registry.h"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;

class EmptyEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }
  void AddResiduals(const EnergyContext&, ResidualSink*) const override {}
};

EnergyInfo ExampleInfo() {
  EnergyInfo info;
  info.name = "example";
  info.parameters = {{"gain", ParameterType::kReal, "-", 0.5, 2.0, 1.5, "a real"},
                     {"count", ParameterType::kInteger, "-", -1.0, 9.0, 3.0, "an integer"},
                     {"signed", ParameterType::kFlag, "-", 0.0, 1.0, 1.0, "a flag"}};
  return info;
}

std::unique_ptr<EnergyTerm> MakeEmpty(const ParameterValues&) {
  return std::make_unique<EmptyEnergy>();
}

EnergyRegistry ExampleRegistry() {
  EnergyRegistry registry;
  EXPECT_TRUE(registry.Register(ExampleInfo(), MakeEmpty).ok());
  return registry;
}

std::string CreateError(const std::string& name, const std::map<std::string, double>& parameters) {
  return ExampleRegistry().Create(name, parameters).status().message();
}

TEST(ParameterValues, AreTheDefaultsWhereNothingIsGiven) {
  const StatusOr<ParameterValues> values = ParameterValues::Create(ExampleInfo(), {});
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(values->Get("gain"), 1.5);
  EXPECT_EQ(values->Get("count"), 3.0);
  EXPECT_TRUE(values->GetFlag("signed"));
}

TEST(ParameterValues, AreWhatIsGiven) {
  const StatusOr<ParameterValues> values =
      ParameterValues::Create(ExampleInfo(), {{"gain", 0.75}, {"count", -1.0}, {"signed", 0.0}});
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(values->Get("gain"), 0.75);
  EXPECT_EQ(values->Get("count"), -1.0);
  EXPECT_FALSE(values->GetFlag("signed"));
}

TEST(ParameterValues, RefuseAValueOutOfRange) {
  EXPECT_EQ(CreateError("example", {{"gain", 2.5}}),
            "energy 'example': parameter gain=2.5, expected a number in [0.5, 2]");
  EXPECT_EQ(CreateError("example", {{"gain", 0.25}}),
            "energy 'example': parameter gain=0.25, expected a number in [0.5, 2]");
  EXPECT_NE(CreateError("example", {{"gain", std::nan("")}}), "");
  EXPECT_NE(CreateError("example", {{"gain", std::numeric_limits<double>::infinity()}}), "");
}

TEST(ParameterValues, RefuseAFractionForAWholeNumber) {
  EXPECT_EQ(CreateError("example", {{"count", 2.5}}),
            "energy 'example': parameter count=2.5, expected a whole number in [-1, 9]");
  EXPECT_EQ(CreateError("example", {{"signed", 0.5}}),
            "energy 'example': parameter signed=0.5, expected a whole number in [0, 1]");
}

TEST(ParameterValues, RefuseAnUnknownNameAndListTheKnownOnes) {
  EXPECT_EQ(CreateError("example", {{"gian", 1.0}}),
            "energy 'example' has no parameter 'gian'; it knows: gain, count, signed; every energy "
            "knows: weight, loss, loss_width");
  EnergyInfo bare;
  bare.name = "bare";
  EXPECT_EQ(ParameterValues::Create(bare, {{"x", 1.0}}).status().message(),
            "energy 'bare' has no parameter 'x'; it knows: none; every energy knows: weight, loss, "
            "loss_width");
}

TEST(ParameterValues, ThrowOnAParameterThatTheEnergyHasNotDeclared) {
  const StatusOr<ParameterValues> values = ParameterValues::Create(ExampleInfo(), {});
  EXPECT_THROW(values->Get("gian"), std::invalid_argument);
}

TEST(EnergyRegistry, RefusesAnUnknownEnergyAndListsTheKnownOnes) {
  EnergyRegistry registry = ExampleRegistry();
  EnergyInfo second;
  second.name = "another";
  ASSERT_TRUE(registry.Register(second, MakeEmpty).ok());
  EXPECT_EQ(registry.Create("exampel", {}).status().message(),
            "no energy 'exampel'; known: another, example");
}

TEST(EnergyRegistry, RefusesANameThatIsTaken) {
  EnergyRegistry registry = ExampleRegistry();
  EXPECT_EQ(registry.Register(ExampleInfo(), MakeEmpty).message(),
            "energy 'example' is registered already");
}

TEST(EnergyRegistry, RefusesANameThatIsNotSnakeCase) {
  for (const std::string name : {"", "Example", "3d", "my-energy", "my energy", "_x", "a:b"}) {
    EnergyInfo info;
    info.name = name;
    EXPECT_EQ(EnergyRegistry().Register(info, MakeEmpty).message(),
              "energy name '" + name + "': expected snake_case (a-z, 0-9, _)");
  }
}

TEST(EnergyRegistry, RefusesADefaultOutOfItsRange) {
  EnergyInfo info = ExampleInfo();
  info.parameters[0].default_value = 3.0;
  EXPECT_EQ(EnergyRegistry().Register(info, MakeEmpty).message(),
            "energy 'example': parameter gain=3, expected a number in [0.5, 2]");
}

TEST(EnergyRegistry, RefusesAParameterThatCouldNotBeSet) {
  EnergyInfo info = ExampleInfo();
  info.parameters[1].name = "weight";
  EXPECT_EQ(EnergyRegistry().Register(info, MakeEmpty).message(),
            "energy 'example': parameter 'weight' is there twice, or is one that every energy has");
  info.parameters[1].name = "gain";
  EXPECT_EQ(EnergyRegistry().Register(info, MakeEmpty).message(),
            "energy 'example': parameter 'gain' is there twice, or is one that every energy has");
}

TEST(EnergyRegistry, RefusesAFactoryThatMakesNothing) {
  EnergyRegistry registry;
  ASSERT_TRUE(
      registry.Register(ExampleInfo(), [](const ParameterValues&) { return nullptr; }).ok());
  EXPECT_EQ(registry.Create("example", {}).status().message(),
            "energy 'example': its factory made nothing");
}

TEST(EnergyRegistry, RefusesAParameterThatTheFactoryDoesNotAskFor) {
  EnergyRegistry registry;
  const auto factory = [](const ParameterValues& values) {
    values.Get("count");
    return std::make_unique<EmptyEnergy>();
  };
  ASSERT_TRUE(registry.Register(ExampleInfo(), factory).ok());
  EXPECT_TRUE(registry.Create("example", {{"count", 2.0}}).ok());
  EXPECT_EQ(registry.Create("example", {{"gain", 1.0}}).status().message(),
            "energy 'example': parameter 'gain' has no use; it uses: count");
}

TEST(EnergyRegistry, TurnsWhatAFactoryThrowsIntoAnErrorThatNamesThePlugin) {
  EnergyRegistry registry;
  registry.SetOrigin("plugin './x.so'");
  const auto factory = [](const ParameterValues& values) {
    values.Get("undeclared");
    return std::make_unique<EmptyEnergy>();
  };
  ASSERT_TRUE(registry.Register(ExampleInfo(), factory).ok());
  EXPECT_EQ(registry.Create("example", {}).status().message(),
            "energy 'example' of plugin './x.so': asks for parameter 'undeclared', which it has "
            "not declared");
}

TEST(EnergyRegistry, RefusesATermOfAnotherKindThanRegistered) {
  EnergyRegistry registry;
  EnergyInfo info = ExampleInfo();
  info.kind = EnergyKind::kObservation;
  ASSERT_TRUE(registry.Register(info, MakeEmpty).ok());
  EXPECT_EQ(registry.Create("example", {}).status().message(),
            "energy 'example': its term is not of the kind that it is registered as");
}

TEST(EnergyRegistry, HandsTheParametersToTheFactory) {
  EnergyRegistry registry;
  double gain = 0.0;
  ASSERT_TRUE(registry
                  .Register(ExampleInfo(),
                            [&](const ParameterValues& values) {
                              gain = values.Get("gain");
                              return std::make_unique<EmptyEnergy>();
                            })
                  .ok());
  ASSERT_TRUE(registry.Create("example", {{"gain", 0.625}}).ok());
  EXPECT_EQ(gain, 0.625);
}

TEST(EnergyRegistry, ListsEnergiesInTheOrderOfTheirNames) {
  const EnergyRegistry registry = BuiltinEnergies();
  std::vector<std::string> names;
  for (const EnergyInfo* info : registry.List()) names.push_back(info->name);
  EXPECT_THAT(names,
              ElementsAre("landmark",
                          "laplacian",
                          "node_prior",
                          "photometric",
                          "pinned_vertex",
                          "point_to_plane",
                          "point_to_point",
                          "pose_prior",
                          "regularization",
                          "rotation",
                          "symmetric_point_to_plane",
                          "temporal_smoothness",
                          "volume"));
  EXPECT_EQ(registry.Find("volume"), registry.List().back());
  EXPECT_EQ(registry.Find("rotaton"), nullptr);
}

TEST(RegisterBuiltinEnergiesDeathTest, DiesWhenANameIsTaken) {
  EnergyRegistry registry = BuiltinEnergies();
  EXPECT_DEATH(RegisterBuiltinEnergies(&registry), "registered already");
}

}  // namespace
}  // namespace ceres_ed
