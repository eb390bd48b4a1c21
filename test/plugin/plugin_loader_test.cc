#include "ceres_ed/plugin/plugin_loader.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/deformation_graph.h>

#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <cost_functions/node_parameters.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string PluginPath(const std::string& name) {
  return std::string(CERES_ED_PLUGIN_DIR) + "/" + name + ".so";
}

std::string LoadError(const std::string& path) {
  EnergyRegistry registry;
  const Status status = LoadPlugin(path, &registry);
  EXPECT_FALSE(status.ok());
  EXPECT_TRUE(registry.List().empty());
  return status.message();
}

// A sink that keeps the cost functions that it is given.
class CollectingSink : public ResidualSink {
 public:
  void Add(std::unique_ptr<ceres::CostFunction> cost, const BlockRef*, int, double) override {
    costs.push_back(std::move(cost));
  }

  std::vector<std::unique_ptr<ceres::CostFunction>> costs;
};

TEST(PluginLoader, AddsTheEnergyBesideTheBuiltinOnes) {
  EnergyRegistry registry = BuiltinEnergies();
  const std::size_t builtin = registry.List().size();
  const Status status = LoadPlugin(PluginPath("good_plugin"), &registry);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(registry.List().size(), builtin + 1);
  ASSERT_NE(registry.Find("anchor"), nullptr);
}

TEST(PluginLoader, RunsTheEnergyWithItsParameters) {
  EnergyRegistry registry;
  ASSERT_TRUE(LoadPlugin(PluginPath("good_plugin"), &registry).ok());
  const auto term = registry.Create("anchor", {{"gain", 4.0}});
  ASSERT_TRUE(term.ok()) << term.status().message();
  DeformationGraph graph;
  graph.AddNode(Eigen::Vector3d::Zero());
  EnergyContext context;
  context.graph = &graph;
  CollectingSink sink;
  (*term)->AddResiduals(context, &sink);

  ASSERT_EQ(sink.costs.size(), 1u);
  double node[kNodeSize];
  SetNodeToRest(node);
  node[kNodeTranslationOffset + 1] = 0.25;
  const double* blocks[] = {node};
  double residuals[3];
  ASSERT_TRUE(sink.costs[0]->Evaluate(blocks, residuals, nullptr));
  EXPECT_EQ(residuals[0], 0.0);
  EXPECT_EQ(residuals[1], 1.0);
  EXPECT_EQ(residuals[2], 0.0);
}

TEST(PluginLoader, RefusesTheSamePluginTwice) {
  EnergyRegistry registry;
  ASSERT_TRUE(LoadPlugin(PluginPath("good_plugin"), &registry).ok());
  const Status again = LoadPlugin(PluginPath("good_plugin"), &registry);
  EXPECT_THAT(again.message(), AllOf(HasSubstr("good_plugin.so"), HasSubstr("anchor")));
}

TEST(PluginLoader, NamesAMissingFile) {
  EXPECT_EQ(LoadError("/nowhere/plugin.so"),
            "plugin '/nowhere/plugin.so': cannot be read: No such file or directory");
}

TEST(PluginLoader, NamesAFileThatIsNoSharedObject) {
  const std::string path = ::testing::TempDir() + "/text.so";
  std::ofstream(path) << "plain text, longer than the header of a shared object\n";
  EXPECT_THAT(LoadError(path), AllOf(HasSubstr(path), HasSubstr("cannot be loaded")));
}

TEST(PluginLoader, NamesASharedObjectThatIsNoPlugin) {
  EXPECT_THAT(LoadError(PluginPath("no_abi_plugin")),
              AllOf(HasSubstr("no_abi_plugin.so"), HasSubstr("exports no ceres_ed_plugin_abi")));
}

TEST(PluginLoader, NamesTheVersionThatDiffersAndNoOther) {
  EXPECT_THAT(LoadError(PluginPath("wrong_abi_plugin")),
              AllOf(HasSubstr("wrong_abi_plugin.so"),
                    HasSubstr("Eigen 3.3.9 (here Eigen 3."),
                    Not(HasSubstr("Ceres ")),
                    Not(HasSubstr("pointer_bytes"))));
}

TEST(PluginLoader, PassesOnTheErrorOfTheRegisterFunction) {
  EXPECT_THAT(LoadError(PluginPath("failing_plugin")),
              AllOf(HasSubstr("failing_plugin.so"), HasSubstr("needs a licence file")));
}

TEST(PluginLoader, PassesOnWhatTheRegisterFunctionThrows) {
  EXPECT_THAT(LoadError(PluginPath("throwing_plugin")),
              AllOf(HasSubstr("throwing_plugin.so"), HasSubstr("threw: cannot find its table")));
}

TEST(PluginLoader, NotesWhereAnEnergyComesFrom) {
  EnergyRegistry registry = BuiltinEnergies();
  ASSERT_TRUE(LoadPlugins(PluginPath("good_plugin") + ";", &registry).ok());
  EXPECT_EQ(registry.Find("anchor")->origin, "plugin '" + PluginPath("good_plugin") + "'");
  EXPECT_EQ(registry.Find("rotation")->origin, "");
}

TEST(PluginLoader, FindsABareNameInTheWorkingDirectory) {
  // A name without a slash finds the file, so the error is about its contents.
  std::ofstream("bare_name.so") << "plain text, longer than the header of a shared object\n";
  EXPECT_THAT(LoadError("bare_name.so"), HasSubstr("./bare_name.so"));
  std::remove("bare_name.so");
}

}  // namespace
}  // namespace ceres_ed
