// Energies that use both sides of a matched pair: symmetric_point_to_plane and photometric.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/energy_laws.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/graph/matrix_form.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TestProblem OffProblem() {
  TestProblemOptions options;
  options.has_camera = true;
  options.target_deviation = 0.2;
  return MakeTestProblem(options);
}

// Returns one number for each residual of energy `name` at `state`.
std::vector<double> Residuals(const std::string& name,
                              const TestProblem& problem,
                              const DeformationState& state) {
  const std::unique_ptr<EnergyTerm> energy = *BuiltinEnergies().Create(name, {});
  std::vector<double> values;
  for (const auto& residual : CollectResiduals(*energy, problem.Context())) {
    values.push_back(EvaluateResiduals(*residual.cost, BlocksAt(residual, state)).residuals[0]);
  }
  return values;
}

TEST(MatchedPairEnergies, ObeyTheLaws) {
  for (const std::string name : {"symmetric_point_to_plane", "photometric"}) {
    EXPECT_THAT(CheckEnergyLaws(BuiltinEnergies(), name), IsEmpty());
  }
}

// A rigid motion of the camera frame and of everything that was observed in it changes no residual.
TEST(MatchedPairEnergies, DoNotSeeAMotionOfCameraAndTargetsTogether) {
  TestProblem problem = OffProblem();
  DeformationState state = RandomState(problem, 0.3, 7);
  CameraPose motion;
  motion.rotation = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1.0, -1.0, 2.0).normalized());
  motion.translation = {0.3, -2.0, 1.0};
  for (const std::string name : {"symmetric_point_to_plane", "photometric"}) {
    const std::vector<double> before = Residuals(name, problem, state);
    TestProblem moved = problem;
    moved.MoveTargets(motion);
    DeformationState moved_state = state;
    CameraPose& camera = moved_state.camera_from_map;
    camera.translation = motion * camera.translation;
    camera.rotation = motion.rotation * camera.rotation;
    const std::vector<double> after = Residuals(name, moved, moved_state);
    ASSERT_EQ(after.size(), problem.correspondences.size());
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-12);
  }
}

TEST(SymmetricPointToPlaneEnergy, IsTheGapAlongTheMeanOfBothNormals) {
  const TestProblem problem = OffProblem();
  const DeformationState state = RandomState(problem, 0.4, 5);
  const Eigen::MatrixXd warped =
      WarpByMatrices(problem.graph, state, problem.skinning, problem.points);
  const std::vector<double> residuals = Residuals("symmetric_point_to_plane", problem, state);
  ASSERT_EQ(residuals.size(), problem.correspondences.size());
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Correspondence& c = problem.correspondences[i];
    const MatchDetail& detail = problem.match_details[c.detail];
    const Eigen::Vector3d gap = warped.col(c.point) - c.target;
    EXPECT_NEAR(
        residuals[i], 0.5 * (detail.source_normal.dot(gap) + detail.target_normal.dot(gap)), 1e-13);
  }
}

// Two points of a circle are moved apart along their chord. Each of the tangent planes gives a
// distance, but the mean of the two normals gives none (Rusinkiewicz 2019).
TEST(SymmetricPointToPlaneEnergy, SeesNoDistanceAlongACircle) {
  TestProblem problem = MakeTestProblem({});
  const auto on_circle = [](double angle) {
    return Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  };
  for (Correspondence& c : problem.correspondences) {
    const double angle = 0.1 + 0.03 * c.point;
    MatchDetail& detail = problem.match_details[c.detail];
    detail.source_normal = on_circle(angle);
    detail.target_normal = on_circle(angle + 0.4);
    c.normal = detail.target_normal;
    c.target = problem.points[c.point] + 2.0 * (on_circle(angle + 0.4) - on_circle(angle));
  }
  const DeformationState rest(problem.graph.num_nodes());
  for (const double r : Residuals("symmetric_point_to_plane", problem, rest)) {
    EXPECT_NEAR(r, 0.0, 1e-14);
  }
  for (const double r : Residuals("point_to_plane", problem, rest)) EXPECT_GT(std::abs(r), 0.1);
}

TEST(SymmetricPointToPlaneEnergy, DoesNotDependOnTheSignOfTheSourcesNormal) {
  TestProblem problem = OffProblem();
  const DeformationState state = RandomState(problem, 0.4, 5);
  const std::vector<double> before = Residuals("symmetric_point_to_plane", problem, state);
  for (MatchDetail& detail : problem.match_details) detail.source_normal *= -1.0;
  EXPECT_EQ(Residuals("symmetric_point_to_plane", problem, state), before);
}

TEST(SymmetricPointToPlaneEnergy, IsPointToPlaneWhereTheSourcesNormalIsUnknown) {
  TestProblem problem = OffProblem();
  const DeformationState state = RandomState(problem, 0.4, 5);
  const std::vector<double> plane = Residuals("point_to_plane", problem, state);
  for (MatchDetail& detail : problem.match_details) detail.source_normal.setZero();
  EXPECT_EQ(Residuals("symmetric_point_to_plane", problem, state), plane);
  for (Correspondence& c : problem.correspondences) c.detail = -1;
  EXPECT_EQ(Residuals("symmetric_point_to_plane", problem, state), plane);
}

TEST(PhotometricEnergy, IsTheBrightnessOfTheTargetAtTheWarpedPointLessThatOfThePoint) {
  const TestProblem problem = OffProblem();
  const DeformationState state = RandomState(problem, 0.4, 5);
  const Eigen::MatrixXd warped =
      WarpByMatrices(problem.graph, state, problem.skinning, problem.points);
  TestProblem changed = problem;
  for (MatchDetail& detail : changed.match_details) detail.source_intensity -= 0.125;
  const std::vector<double> residuals = Residuals("photometric", changed, state);
  ASSERT_EQ(residuals.size(), problem.correspondences.size());
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Correspondence& c = problem.correspondences[i];
    const MatchDetail& detail = problem.match_details[c.detail];
    const Eigen::Vector3d gap = warped.col(c.point) - c.target;
    EXPECT_NEAR(residuals[i], 0.125 + detail.intensity_gradient.dot(gap), 1e-13);
  }
}

TEST(PhotometricEnergy, IsSilentWhereABrightnessIsUnknown) {
  TestProblem problem = OffProblem();
  ASSERT_GE(problem.correspondences.size(), 4u);
  problem.match_details[problem.correspondences[0].detail].source_intensity = kUnknown;
  problem.match_details[problem.correspondences[1].detail].target_intensity = kUnknown;
  problem.correspondences[2].detail = -1;
  const DeformationState state = RandomState(problem, 0.4, 5);
  EXPECT_EQ(Residuals("photometric", problem, state).size(), problem.correspondences.size() - 3);
  problem.match_details.clear();
  for (Correspondence& c : problem.correspondences) c.detail = -1;
  EXPECT_THAT(Residuals("photometric", problem, state), IsEmpty());
}

TEST(PhotometricEnergy, PassesOnTheWeightOfItsPair) {
  TestProblem problem = OffProblem();
  for (Correspondence& c : problem.correspondences) c.weight = 0.25 + c.point;
  const auto residuals =
      CollectResiduals(**BuiltinEnergies().Create("photometric", {}), problem.Context());
  ASSERT_EQ(residuals.size(), problem.correspondences.size());
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    EXPECT_EQ(residuals[i].weight, problem.correspondences[i].weight);
  }
}

}  // namespace
}  // namespace ceres_ed
