#include <ceres_ed/statistics/procrustes.h>

#include <vector>

#include <gtest/gtest.h>
#include <test/statistics/shape_family.h>

namespace ceres_ed {
namespace {

constexpr int kVertices = 40;

Eigen::VectorXd RandomShape(std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd shape(3 * kVertices);
  for (Eigen::Index i = 0; i < shape.size(); ++i) shape[i] = random.Gaussian();
  return shape;
}

Similarity RandomSimilarity(std::uint64_t seed) {
  Random random(seed);
  Similarity similarity;
  similarity.scale = 0.5 + random.Uniform();
  similarity.rotation =
      Eigen::Quaterniond(random.Gaussian(), random.Gaussian(), random.Gaussian(), random.Gaussian())
          .normalized();
  similarity.translation = {random.Gaussian(), 100.0 * random.Gaussian(), random.Gaussian()};
  return similarity;
}

double CentroidSize(const Eigen::VectorXd& shape) {
  Eigen::Matrix3Xd points = Eigen::Map<const Eigen::Matrix3Xd>(shape.data(), 3, kVertices);
  points.colwise() -= points.rowwise().mean().eval();
  return points.norm();
}

ShapesInMemory Moved(const Eigen::VectorXd& shape, int count, bool scaled) {
  ShapesInMemory::Matrix rows(count, shape.size());
  for (int i = 0; i < count; ++i) {
    Similarity move = RandomSimilarity(10 + i);
    if (!scaled) move.scale = 1.0;
    rows.row(i) = TransformShape(move, shape);
  }
  return ShapesInMemory(rows);
}

Eigen::VectorXd Aligned(const ShapeTable& table, const AlignedShapes& aligned, int row) {
  Eigen::VectorXd shape(table.num_values());
  EXPECT_TRUE(table.Read(row, 0, table.num_values(), shape.data()).ok());
  return TransformShape(aligned.transforms[row], shape);
}

TEST(Procrustes, TakesMovedCopiesToOneShape) {
  const Eigen::VectorXd shape = RandomShape(1);
  const ShapesInMemory table = Moved(shape, 6, /*scaled=*/true);
  const StatusOr<AlignedShapes> aligned = AlignShapes(table, Alignment::kSimilarity, shape);
  ASSERT_TRUE(aligned.ok());
  for (int i = 1; i < 6; ++i) {
    EXPECT_LT((Aligned(table, *aligned, i) - Aligned(table, *aligned, 0)).norm(), 1e-9);
  }
}

TEST(Procrustes, PutsTheMeanWhereTheFrameIs) {
  const Eigen::VectorXd shape = RandomShape(2);
  const ShapesInMemory table = Moved(shape, 5, /*scaled=*/false);
  const StatusOr<AlignedShapes> aligned = AlignShapes(table, Alignment::kRigid, shape);
  ASSERT_TRUE(aligned.ok());
  for (int i = 0; i < 5; ++i) EXPECT_LT((Aligned(table, *aligned, i) - shape).norm(), 1e-9);
}

TEST(Procrustes, KeepsSizesUnlessTheyAreTakenOut) {
  const Eigen::VectorXd shape = RandomShape(3);
  const ShapesInMemory table = Moved(shape, 5, /*scaled=*/true);
  const StatusOr<AlignedShapes> form = AlignShapes(table, Alignment::kRigid, shape);
  const StatusOr<AlignedShapes> pure = AlignShapes(table, Alignment::kSimilarity, shape);
  ASSERT_TRUE(form.ok() && pure.ok());
  double mean_size = 0.0;
  for (int i = 0; i < 5; ++i) {
    const double size = RandomSimilarity(10 + i).scale * CentroidSize(shape);
    EXPECT_NEAR(CentroidSize(Aligned(table, *form, i)), size, 1e-9);
    mean_size += size / 5;
  }
  EXPECT_NEAR(CentroidSize(Aligned(table, *pure, 3)), mean_size, 1e-9);
}

// At the minimum no rotation of one shape brings it nearer to the mean of all.
TEST(Procrustes, EachShapeIsTurnedToTheMean) {
  ShapesInMemory::Matrix rows(8, 3 * kVertices);
  const Eigen::VectorXd shape = RandomShape(4);
  for (int i = 0; i < 8; ++i) {
    const Eigen::VectorXd other = shape + 0.2 * RandomShape(50 + i);
    rows.row(i) = TransformShape(RandomSimilarity(20 + i), other);
  }
  const ShapesInMemory table(rows);
  const StatusOr<AlignedShapes> aligned = AlignShapes(table, Alignment::kSimilarity, shape);
  ASSERT_TRUE(aligned.ok());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(3 * kVertices);
  for (int i = 0; i < 8; ++i) mean += Aligned(table, *aligned, i) / 8;
  const Eigen::Map<const Eigen::Matrix3Xd> to(mean.data(), 3, kVertices);
  for (int i = 0; i < 8; ++i) {
    const Eigen::VectorXd row = Aligned(table, *aligned, i);
    const Eigen::Map<const Eigen::Matrix3Xd> from(row.data(), 3, kVertices);
    const Eigen::Matrix4d rest = Eigen::umeyama(from, to, false);
    EXPECT_LT((rest - Eigen::Matrix4d::Identity()).norm(), 1e-7);
  }
}

TEST(Procrustes, NamesAShapeOfOnePoint) {
  ShapesInMemory::Matrix rows(2, 3 * kVertices);
  rows.row(0) = RandomShape(5);
  rows.row(1).setOnes();
  const Status status =
      AlignShapes(ShapesInMemory(rows), Alignment::kSimilarity, RandomShape(5)).status();
  EXPECT_NE(status.message().find("shape 1"), std::string::npos) << status.message();
}

}  // namespace
}  // namespace ceres_ed
