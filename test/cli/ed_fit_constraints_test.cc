// Landmarks and fixed vertices of ed_fit, on the shipped dolphin and on a ring.
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/io/point_list_io.h>

#include <gmock/gmock.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

const std::string kDolphin = std::string(CERES_ED_SOURCE_DIR) + "/data/dolphin_bend/";

class EdFitConstraintsTest : public EdFitTest {
 protected:
  ProgramResult FitDolphin(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), kDolphin + "source.ply");
    arguments.push_back("--output=" + (dir_ / "dolphin.ply"));
    arguments.push_back("--report=" + (dir_ / "report.json"));
    return RunProgramFile(AppPath("ed_fit"), arguments);
  }

  // Largest distance of a landmark from its place.
  double LandmarkError() const {
    const std::vector<Eigen::Vector3d> points = Load("dolphin.ply").cloud.points;
    const auto landmarks = ReadLandmarks(kDolphin + "landmarks.csv", int(points.size()));
    EXPECT_TRUE(landmarks.ok());
    double largest = 0.0;
    for (const Landmark& landmark : *landmarks) {
      largest = std::max(largest, (points[landmark.point] - landmark.position).norm());
    }
    return largest;
  }

  // Largest motion of a fixed vertex.
  double FixedError() const {
    const std::vector<Eigen::Vector3d> fitted = Load("dolphin.ply").cloud.points;
    const auto source = LoadCloud(kDolphin + "source.ply");
    const auto fixed = ReadVertexList(kDolphin + "fixed.txt", int(fitted.size()));
    double largest = 0.0;
    for (const int vertex : *fixed) {
      largest = std::max(largest, (fitted[vertex] - source->cloud.points[vertex]).norm());
    }
    return largest;
  }
};

// The dolphin is 1 m long.
TEST_F(EdFitConstraintsTest, LandmarksAloneBringHandlesToTheirPlaces) {
  const ProgramResult result = FitDolphin({"--landmarks=" + kDolphin + "landmarks.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("landmarks  "));
  const double error = LandmarkError();
  EXPECT_LT(error, 0.01);
  const nlohmann::json report = Report();
  EXPECT_TRUE(report["target"].is_null());
  EXPECT_NEAR(report["landmarks"]["max"], error, 1e-6);
}

TEST_F(EdFitConstraintsTest, FixedVerticesStayWhileHandlesMove) {
  const ProgramResult result = FitDolphin(
      {"--landmarks=" + kDolphin + "landmarks.csv", "--fixed=" + kDolphin + "fixed.txt"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("ed_fit: warning: no rigid motion is sought: --fixed"));
  EXPECT_LT(LandmarkError(), 0.01);
  EXPECT_LT(FixedError(), 0.002);
  EXPECT_NEAR(Report()["fixed"]["max"], FixedError(), 1e-6);
  EXPECT_EQ(Report()["rigid"]["rotation_deg"], 0.0);
}

// Rows of a landmark file.
std::string LandmarkRow(int vertex, const Eigen::Vector3d& position) {
  std::ostringstream row;
  row.precision(17);
  row << vertex << ',' << position.x() << ',' << position.y() << ',' << position.z() << '\n';
  return row.str();
}

// Columns 11 to 13 of 24 are the end of the ring at x < -0.5, which the truth leaves at its place.
bool IsAtRest(int vertex) { return vertex % 24 >= 11 && vertex % 24 <= 13; }

Eigen::Vector3d SourcePoint(int vertex) {
  const int row = vertex / 24;
  return RingPoint(vertex % 24 / 24.0, row / 12.0);
}

TEST_F(EdFitTest, LandmarksPullAlongATarget) {
  // The ring may turn a little within itself; these two are told not to.
  std::string rows = "source_index,x,y,z\n";
  const int vertices[] = {0, 24 * 6 + 5};
  for (const int vertex : vertices) rows += LandmarkRow(vertex, BentPoint(SourcePoint(vertex)));
  WriteBytes(dir_ / "landmarks.csv", rows);
  const ProgramResult result =
      FitPair({"--landmarks=" + (dir_ / "landmarks.csv"), "--report=" + (dir_ / "report.json")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const PointCloud fitted = Load("out.ply").cloud;
  for (const int vertex : vertices) {
    EXPECT_LT((fitted.points[vertex] - BentPoint(SourcePoint(vertex))).norm(), 0.01);
  }
  EXPECT_LT(Summarize(SurfaceDistances(fitted.points, Load("target.ply").cloud)).max,
            2.0 * kRingFacets);
  EXPECT_EQ(Report()["landmarks"]["count"], 2);
}

TEST_F(EdFitTest, FixedVerticesStayWhileTheRestFollowsATarget) {
  std::string fixed;
  for (int i = 0; i < 24 * 12; ++i) fixed += IsAtRest(i) ? std::to_string(i) + "\n" : "";
  WriteBytes(dir_ / "fixed.txt", fixed);
  ASSERT_EQ(FitPair({"--fixed=" + (dir_ / "fixed.txt")}).exit_code, 0);
  const PointCloud fitted = Load("out.ply").cloud;
  for (int i = 0; i < 24 * 12; ++i) {
    if (!IsAtRest(i)) continue;
    EXPECT_LT((fitted.points[i] - SourcePoint(i)).norm(), 1e-3) << "vertex " << i;
  }
  EXPECT_LT(Summarize(SurfaceDistances(fitted.points, Load("target.ply").cloud)).max,
            2.0 * kRingFacets);
}

TEST_F(EdFitTest, IndicesCountTheVerticesOfTheFile) {
  // Vertex 0 is dropped, so that the index of every other vertex differs from that of its point.
  RingOptions hole;
  hole.is_nan = [](int i) { return i == 0; };
  WritePair(hole, {});
  const Eigen::Vector3d raised = SourcePoint(24 * 3) + Eigen::Vector3d(0.0, 0.0, 0.1);
  WriteBytes(dir_ / "landmarks.csv", LandmarkRow(24 * 3, raised));
  std::string fixed;
  for (int i = 0; i < 24 * 12; ++i) fixed += IsAtRest(i) ? std::to_string(i) + " " : "";
  WriteBytes(dir_ / "fixed.txt", fixed);
  ASSERT_EQ(RunProgramFile(AppPath("ed_fit"),
                           {dir_ / "source.ply",
                            "--landmarks=" + (dir_ / "landmarks.csv"),
                            "--fixed=" + (dir_ / "fixed.txt"),
                            "--node_spacing=0.2",
                            "--output=" + (dir_ / "out.ply")})
                .exit_code,
            0);
  const PointCloud fitted = Load("out.ply").cloud;
  ASSERT_EQ(fitted.size(), 24u * 12u - 1u);
  EXPECT_LT((fitted.points[24 * 3 - 1] - raised).norm(), 0.005);
  for (int i = 0; i < 24 * 12; ++i) {
    if (!IsAtRest(i)) continue;
    EXPECT_LT((fitted.points[i - 1] - SourcePoint(i)).norm(), 1e-3) << "vertex " << i;
  }
}

}  // namespace
}  // namespace ceres_ed
