// The modes of a population that is fitted from its meshes alone.
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/pipeline/cohort/cohort_run.h>
#include <ceres_ed/simulation/shape_family.h>
#include <ceres_ed/statistics/procrustes.h>
#include <ceres_ed/statistics/shape_model.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

ShapesInMemory::Matrix RowsOf(const std::vector<std::vector<Eigen::Vector3d>>& shapes) {
  ShapesInMemory::Matrix rows(shapes.size(), 3 * shapes[0].size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t v = 0; v < shapes[i].size(); ++v) {
      rows.block<1, 3>(i, 3 * v) = shapes[i][v].transpose();
    }
  }
  return rows;
}

Eigen::VectorXd Flat(const std::vector<Eigen::Vector3d>& points) { return RowsOf({points}).row(0); }

// Returns the model of the true shapes, aligned like those that were found.
ShapeModel TrueModel(const ShapeFamily& family) {
  std::vector<std::vector<Eigen::Vector3d>> shapes;
  for (int i = 0; i < family.size(); ++i) shapes.push_back(family.Truth(i));
  const ShapesInMemory table(RowsOf(shapes));
  const auto aligned = AlignShapes(table, Alignment::kSimilarity, Flat(family.source().points));
  EXPECT_TRUE(aligned.ok());
  ShapesInMemory::Matrix rows(table.num_shapes(), table.num_values());
  for (int i = 0; i < family.size(); ++i) {
    rows.row(i) = TransformShape(aligned->transforms[i], Flat(shapes[i]));
  }
  return *FitShapeModel(ShapesInMemory(rows), 3);
}

TEST(CohortModel, FindsTheModesThatWerePutIn) {
  ShapeFamilyOptions options;
  options.shapes = 20;
  options.vertices = 1600;
  const ShapeFamily family(options);
  const TemporaryDirectory folder;
  ASSERT_TRUE(WriteCloud(folder / "template.ply", family.source()).ok());
  std::string table = "name,path,group\n";
  for (int i = 0; i < family.size(); ++i) {
    const std::string name = "shape_" + std::to_string(i);
    ASSERT_TRUE(WriteCloud(folder / (name + ".ply"), family.Shape(i)).ok());
    table +=
        name + "," + name + ".ply," + (family.amplitudes(i)[0] > 0.0 ? "left" : "right") + "\n";
  }
  WriteBytes(folder / "shapes.csv", table);
  CohortSettings settings;
  settings.source = folder / "template.ply";
  settings.manifest = folder / "shapes.csv";
  settings.output = folder / "out";
  settings.pages = false;
  CohortObserver observer;
  const Outcome outcome = RunCohort(settings, Timer(), &observer);
  ASSERT_TRUE(outcome.done()) << outcome.message;

  const ShapeModel truth = TrueModel(family);
  const StatusOr<NpyArray> aligned = ReadNpyFile(folder / "out/aligned.npy");
  const StatusOr<NpyArray> components = ReadNpyFile(folder / "out/components.npy");
  ASSERT_TRUE(aligned.ok() && components.ok());
  ASSERT_EQ(aligned->shape[0], 20u);
  const auto size = static_cast<Eigen::Index>(3 * aligned->shape[1]);
  const Eigen::Map<const ShapesInMemory::Matrix> rows(aligned->values.data(), 20, size);
  const StatusOr<ShapeModel> found = FitShapeModel(ShapesInMemory(rows), 3);
  ASSERT_TRUE(found.ok());
  constexpr double kMaxAngle = 10.0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Map<const Eigen::VectorXd> component(components->values.data() + k * size, size);
    EXPECT_NEAR(component.dot(found->components.col(k)), 1.0, 1e-9);
    const double cosine = std::abs(component.dot(truth.components.col(k)));
    EXPECT_LT(std::acos(std::min(1.0, cosine)) * 180.0 / M_PI, kMaxAngle) << k;
    EXPECT_NEAR(found->variances[k], truth.variances[k], 0.15 * truth.variances[k]) << k;
  }
  const StatusOr<LoadedCloud> groups = LoadCloud(folder / "out/groups.ply");
  ASSERT_TRUE(groups.ok());
  // The groups are the signs of the first mode.
  const auto& p = groups->document.Find("vertex")->Find("p_corrected")->values;
  EXPECT_LT(*std::min_element(p.begin(), p.end()), 0.01);
}

}  // namespace
}  // namespace ceres_ed
