// The energies that are not used by default: laplacian, pinned_vertex, temporal_smoothness, volume.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/testing/energy_laws.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <ceres/solver.h>
#include <cost_functions/volume_cost.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/slam/bumpy_sequence.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

EnergySpec Spec(const std::string& name, double weight, double point = -1.0) {
  EnergySpec spec;
  spec.name = name;
  spec.weight = weight;
  if (point >= 0.0) spec.parameters["point"] = point;
  return spec;
}

FitResult FitLandmarks(const PointCloud& source,
                       const std::vector<Landmark>& landmarks,
                       const std::vector<EnergySpec>& energies) {
  FitInput input;
  input.source = source;
  input.landmarks = landmarks;
  FitOptions options;
  options.rigid_first = false;
  options.extra_energies = energies;
  const StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
  EXPECT_TRUE(fit.ok()) << fit.status().message();
  return fit.ok() ? *fit : FitResult();
}

TEST(LaplacianEnergy, ObeysTheLaws) {
  EnergyClaims claims;
  claims.invariances = {
      {"a translation of all nodes", [](const DeformationGraph&, DeformationState* state) {
         for (int j = 0; j < state->num_nodes(); ++j) {
           MutableNodeTranslation(state->node(j)) += Eigen::Vector3d(1, -2, 0.5);
         }
       }}};
  EXPECT_THAT(CheckEnergyLaws(BuiltinEnergies(), "laplacian", claims), IsEmpty());
}

TEST(LaplacianEnergy, PutsANodeBetweenItsNeighbours) {
  DeformationGraph graph;
  for (int j = 0; j < 3; ++j) graph.AddNode({1.0 * j, 0.0, 0.0});
  for (const GraphEdge& edge :
       {GraphEdge{0, 1, 1.0}, GraphEdge{1, 0, 3.0}, GraphEdge{1, 2, 1.0}, GraphEdge{2, 1, 1.0}}) {
    graph.AddEdge(edge);
  }
  EnergyContext context;
  context.graph = &graph;
  ProblemBuilder builder(graph, /*has_camera=*/false);
  const auto energy = BuiltinEnergies().Create("laplacian", {});
  builder.CollectResiduals(builder.AddTerm("laplacian", (*energy)->kind()), **energy, context);
  DeformationState state(3);
  MutableNodeTranslation(state.node(2)).z() = 2.0;
  ProblemConfig config = FullConfig(3, false);
  config.variable_nodes = {0, 1, 0};
  const BuiltProblem built = builder.Build(config, &state);
  ceres::Solver::Options options;
  options.function_tolerance = options.gradient_tolerance = 1e-14;
  // The problem is linear, so one step without damping is exact.
  options.initial_trust_region_radius = 1e14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, built.problem.get(), &summary);
  // The minimum of (t - 0)^2 + (t - (3 * 0 + 2) / 4)^2 + (2 - t)^2 is at 5 / 6.
  EXPECT_NEAR(NodeTranslation(state.node(1)).z(), 5.0 / 6.0, 1e-9);
}

TEST(PinnedVertexEnergy, ObeysTheLaws) {
  EXPECT_THAT(CheckEnergyLaws(BuiltinEnergies(),
                              "pinned_vertex",
                              [] {
                                EnergyClaims claims;
                                // Any integer is a point of some source, but not of this one.
                                claims.parameters = {{"point", 3.0}};
                                return claims;
                              }()),
              IsEmpty());
}

TEST(PinnedVertexEnergy, HoldsItsPointWhileAnotherIsPulled) {
  const PointCloud sheet = MakeSyntheticShape(SyntheticShape::kPlane, 600, 1.0);
  const int pulled = 0;
  const int last = static_cast<int>(sheet.size()) - 1;
  const std::vector<Landmark> landmarks = {
      {pulled, sheet.points[pulled] + Eigen::Vector3d(0.0, 0.0, 0.2)}};
  const FitResult free = FitLandmarks(sheet, landmarks, {});
  const FitResult pinned = FitLandmarks(sheet, landmarks, {Spec("pinned_vertex", 1e3, 1.0 * last)});
  // Without the pin, a landmark lifts the whole sheet.
  EXPECT_GT((free.points[last] - sheet.points[last]).norm(), 0.05);
  EXPECT_LT((pinned.points[last] - sheet.points[last]).norm(), 1e-3);
  EXPECT_NEAR(pinned.points[pulled].z(), 0.2, 0.01);
}

TEST(PinnedVertexEnergy, SaysThatAPointIsNotThere) {
  const PointCloud sheet = MakeSyntheticShape(SyntheticShape::kPlane, 600, 1.0);
  const FitResult fit =
      FitLandmarks(sheet, {{0, sheet.points[0]}}, {Spec("pinned_vertex", 1.0, 1.0 * sheet.size())});
  EXPECT_EQ(fit.status, SolveStatus::kFailed);
  EXPECT_THAT(fit.message,
              HasSubstr("point " + std::to_string(sheet.size()) +
                        " is not there, expected one of " + std::to_string(sheet.size())));
}

TEST(TemporalSmoothnessEnergy, ObeysTheLaws) {
  EXPECT_THAT(CheckEnergyLaws(BuiltinEnergies(), "temporal_smoothness"), IsEmpty());
}

// Returns how far nodes move from frame to frame on a sheet that moves up and down, in metres.
double MeanStep(double weight) {
  BumpyScene scene;
  scene.heave = 0.004;
  scene.camera_step = 0.0;
  SlamOptions options;
  options.nodes_in_view = 40;
  options.camera = CameraMode::kFixed;
  if (weight > 0.0) options.levels.energies = {Spec("temporal_smoothness", weight)};
  auto slam = DeformableSlam::Create(BumpyCamera(), options, BuiltinEnergies());
  EXPECT_TRUE(slam.ok()) << slam.status().message();
  double sum = 0.0;
  int count = 0;
  std::vector<Eigen::Vector3d> before;
  for (int frame = 0; frame < 5; ++frame) {
    const DepthImage depth = scene.RenderDepth(frame);
    SlamFrame input;
    input.number = frame;
    input.depth = &depth;
    const FrameReport report = (*slam)->Process(input);
    EXPECT_EQ(report.fault, "");
    const DeformationState& state = (*slam)->map().state();
    for (std::size_t j = 0; j < before.size(); ++j) {
      sum += (NodeTranslation(state.node(static_cast<int>(j))) - before[j]).norm();
      ++count;
    }
    before.clear();
    for (int j = 0; j < state.num_nodes(); ++j) before.push_back(NodeTranslation(state.node(j)));
  }
  EXPECT_THAT((*slam)->IdleEnergies(), IsEmpty());
  return sum / count * (*slam)->unit();
}

TEST(TemporalSmoothnessEnergy, SlowsNodesDown) {
  const double free = MeanStep(0.0);
  const double slow = MeanStep(10.0);
  const double still = MeanStep(1e6);
  // The sheet moves by up to 1.6 mm in each frame.
  EXPECT_GT(free, 5e-4);
  EXPECT_LT(slow, 0.8 * free);
  EXPECT_LT(still, 1e-3 * free);
}

TEST(TrackerFault, IsToldInItsFrameAlone) {
  bool fails = false;
  EnergyRegistry registry = BuiltinEnergies();
  EnergyInfo info{"moody", "a test", "-", "-", EnergyKind::kPrior, {}, ""};
  const Status status = registry.Register(info, [&fails](const ParameterValues&) {
    return MakeEnergy(EnergyKind::kPrior, [&fails](const EnergyContext&, ResidualSink*) {
      if (fails) throw std::runtime_error("not today");
    });
  });
  ASSERT_TRUE(status.ok()) << status.message();
  SlamOptions options;
  options.nodes_in_view = 40;
  options.levels.energies = {Spec("moody", 1.0)};
  auto slam = DeformableSlam::Create(BumpyCamera(), options, registry);
  ASSERT_TRUE(slam.ok()) << slam.status().message();
  const BumpyScene scene;
  for (int frame = 0; frame < 4; ++frame) {
    fails = frame == 2;
    const DepthImage depth = scene.RenderDepth(frame);
    SlamFrame input;
    input.number = frame;
    input.depth = &depth;
    const FrameReport report = (*slam)->Process(input);
    if (fails) {
      EXPECT_THAT(report.fault, HasSubstr("energy 'moody': after 0 residuals it threw: not today"));
    } else {
      EXPECT_EQ(report.fault, "") << frame;
    }
  }
}

// Returns a box of 1 x 2 x 3 around `centre`. With `welded` it has 8 vertices, otherwise three for
// each triangle.
PointCloud MakeBox(const Eigen::Vector3d& centre, bool welded) {
  PointCloud box;
  for (int i = 0; i < 8; ++i) {
    box.points.push_back(centre +
                         Eigen::Vector3d((i & 1) - 0.5, (i & 2) - 1.0, 0.75 * (i & 4) - 1.5));
  }
  box.triangles = {{0, 2, 1},
                   {1, 2, 3},
                   {4, 5, 6},
                   {5, 7, 6},
                   {0, 1, 4},
                   {1, 5, 4},
                   {2, 6, 3},
                   {3, 6, 7},
                   {0, 4, 2},
                   {2, 4, 6},
                   {1, 3, 5},
                   {3, 7, 5}};
  if (welded) return box;
  PointCloud soup;
  for (const std::array<int, 3>& t : box.triangles) {
    const int first = static_cast<int>(soup.size());
    for (const int corner : t) soup.points.push_back(box.points[corner]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(EnclosedVolume, IsThatOfABox) {
  const Eigen::Vector3d centre(5.0, -7.0, 2.0);
  for (const bool welded : {true, false}) {
    const PointCloud box = MakeBox(centre, welded);
    EXPECT_NEAR(EnclosedVolume(box.points, box.triangles, centre), 6.0, 1e-12);
    EXPECT_NEAR(EnclosedVolume(box.points, box.triangles, {0.0, 0.0, 0.0}), 6.0, 1e-10);
  }
}

// A box on four nodes. Every vertex is bound to all of them.
struct BoxProblem {
  explicit BoxProblem(PointCloud cloud) : box(std::move(cloud)), builder(MakeGraph(), false) {
    const int nodes[] = {0, 1, 2, 3};
    for (std::size_t i = 0; i < box.size(); ++i) {
      const double w = 0.1 + 0.02 * static_cast<double>(i % 8);
      const double weights[] = {w, 0.5 - w, 0.2, 0.3};
      skinning.Add(nodes, weights, 4);
    }
    EnergyContext context;
    context.graph = &graph;
    context.points = &box.points;
    context.skinning = &skinning;
    context.triangles = &box.triangles;
    energy = *BuiltinEnergies().Create("volume", {});
    builder.CollectResiduals(builder.AddTerm("volume", energy->kind()), *energy, context);
  }

  const DeformationGraph& MakeGraph() {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) graph.AddNode({x, y, 0.3 * x * y});
    }
    return graph;
  }

  // Returns the residual when the nodes move by x -> M x + t.
  double ResidualAt(const Eigen::Matrix3d& M, const Eigen::Vector3d& t) const {
    DeformationState state(4);
    for (int j = 0; j < 4; ++j) {
      const Eigen::Vector3d& g = graph.position(j);
      MutableNodeAffine(state.node(j)) = M;
      MutableNodeTranslation(state.node(j)) = M * g + t - g;
    }
    const EnergySummary summary = builder.Evaluate(state);
    return std::sqrt(2.0 * summary.terms[0].raw);
  }

  PointCloud box;
  DeformationGraph graph;
  Skinning skinning;
  std::unique_ptr<EnergyTerm> energy;
  ProblemBuilder builder;
};

TEST(VolumeEnergy, IsTheShareByWhichAMapChangesVolumes) {
  for (const bool welded : {true, false}) {
    const BoxProblem problem(MakeBox({0.3, 0.1, -0.2}, welded));
    ASSERT_EQ(problem.builder.NumResidualBlocks(0), 1);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    EXPECT_NEAR(problem.ResidualAt(R, {3.0, 0.0, -4.0}), 0.0, 1e-12);
    EXPECT_NEAR(problem.ResidualAt(1.1 * R, {0.0, 0.5, 0.0}), std::pow(1.1, 3) - 1.0, 1e-12);
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 1) = 0.7;
    EXPECT_NEAR(problem.ResidualAt(shear, {0.0, 0.0, 0.0}), 0.0, 1e-12);
  }
}

TEST(VolumeEnergy, ObeysTheLawsOfCosts) {
  const BoxProblem problem(MakeBox({0.3, 0.1, -0.2}, true));
  const std::vector<SelectedResidual> selected = problem.builder.Select(FullConfig(4, false));
  ASSERT_EQ(selected.size(), 1u);
  CostClaims claims;
  claims.rest.assign(4, RestNode());
  claims.squared_norm_at_rest = 0.0;
  EXPECT_THAT(CheckCostLaws(*selected[0].CostFunction(problem.graph), claims), IsEmpty());
}

TEST(VolumeEnergy, AddsNothingToAMeshThatIsNotClosed) {
  PointCloud open = MakeBox({0, 0, 0}, true);
  open.triangles.pop_back();
  EXPECT_EQ(BoxProblem(open).builder.NumResidualBlocks(0), 0);
  PointCloud turned = MakeBox({0, 0, 0}, true);
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_EQ(BoxProblem(turned).builder.NumResidualBlocks(0), 0);
}

TEST(VolumeEnergy, LetsASqueezedBodyBulge) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kKidney, 800, 1.0);
  // Its lowest and its highest vertex come nearer to each other by a third.
  const auto by_z = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.z() < b.z();
  };
  const auto [low, high] = std::minmax_element(body.points.begin(), body.points.end(), by_z);
  const double height = high->z() - low->z();
  const Eigen::Vector3d up(0.0, 0.0, height / 6.0);
  const std::vector<Landmark> landmarks = {
      {static_cast<int>(low - body.points.begin()), *low + up},
      {static_cast<int>(high - body.points.begin()), *high - up}};
  const double rest = EnclosedVolume(body.points, body.triangles, {0, 0, 0});
  const auto change = [&](const std::vector<EnergySpec>& energies) {
    const FitResult fit = FitLandmarks(body, landmarks, energies);
    EXPECT_TRUE(fit.IsUsable()) << fit.message;
    return EnclosedVolume(fit.points, body.triangles, {0, 0, 0}) / rest - 1.0;
  };
  const double free = change({});
  const double kept = change({Spec("volume", 1e5)});
  EXPECT_GT(std::abs(free), 0.02);
  EXPECT_LT(std::abs(kept), 0.1 * std::abs(free));
}

}  // namespace
}  // namespace ceres_ed
