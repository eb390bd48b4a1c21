#include <ceres_ed/statistics/group_test.h>

#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <test/statistics/shape_family.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

// Shapes of noise; those of group 1 have vertex 0 elsewhere.
ShapesInMemory::Matrix Noise(int shapes, int vertices, std::uint64_t seed) {
  Random random(seed);
  ShapesInMemory::Matrix rows(shapes, 3 * vertices);
  for (Eigen::Index i = 0; i < rows.size(); ++i) rows.data()[i] = random.Gaussian();
  return rows;
}

std::vector<int> Alternating(int shapes) {
  std::vector<int> groups;
  for (int i = 0; i < shapes; ++i) groups.push_back(i % 2);
  return groups;
}

TEST(GroupTest, FindsTheVertexThatDiffers) {
  ShapesInMemory::Matrix rows = Noise(30, 20, 1);
  for (int i = 1; i < 30; i += 2) rows(i, 0) += 4.0;
  const StatusOr<GroupTest> test = TestGroups(ShapesInMemory(rows), Alternating(30));
  ASSERT_TRUE(test.ok());
  EXPECT_DOUBLE_EQ(test->p[0], 1.0 / 1001.0);
  EXPECT_DOUBLE_EQ(test->p_corrected[0], 1.0 / 1001.0);
  EXPECT_NEAR(test->difference[0], 4.0, 1.0);
  EXPECT_GT(*std::min_element(test->p_corrected.begin() + 1, test->p_corrected.end()), 0.05);
}

// With 3 + 3 shapes there are 20 assignments, and that in which the groups lie apart occurs twice.
TEST(GroupTest, GivesTheExactProbabilityOfSmallGroups) {
  ShapesInMemory::Matrix rows = ShapesInMemory::Matrix::Zero(6, 3);
  for (int i = 0; i < 6; ++i) rows(i, 0) = (i % 2 == 0 ? 10.0 : 20.0) + 0.1 * i;
  GroupTestOptions options;
  options.permutations = 20000;
  const StatusOr<GroupTest> test = TestGroups(ShapesInMemory(rows), Alternating(6), options);
  ASSERT_TRUE(test.ok());
  EXPECT_NEAR(test->p[0], 0.1, 0.01);
}

// F by its definition, for three groups.
TEST(GroupTest, MeasuresSpreadBetweenAndWithinGroups) {
  const ShapesInMemory::Matrix rows = Noise(9, 1, 3);
  const std::vector<int> groups = {0, 0, 1, 1, 1, 2, 2, 2, 2};
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(3, 3);
  const double sizes[] = {2, 3, 4};
  for (int i = 0; i < 9; ++i) means.row(groups[i]) += rows.row(i) / sizes[groups[i]];
  double between = 0.0;
  double within = 0.0;
  for (int g = 0; g < 3; ++g) {
    between += sizes[g] * (means.row(g) - rows.colwise().mean()).squaredNorm();
  }
  for (int i = 0; i < 9; ++i) within += (rows.row(i) - means.row(groups[i])).squaredNorm();
  const StatusOr<GroupTest> test = TestGroups(ShapesInMemory(rows), groups);
  ASSERT_TRUE(test.ok());
  EXPECT_NEAR(test->statistic[0], (between / 2) / (within / 6), 1e-9);
}

// Of maps without any difference, about one in twenty has a corrected p of at most 0.05.
TEST(GroupTest, CorrectsForTheNumberOfVertices) {
  int found = 0;
  constexpr int kMaps = 200;
  GroupTestOptions options;
  options.permutations = 99;
  for (int map = 0; map < kMaps; ++map) {
    const StatusOr<GroupTest> test =
        TestGroups(ShapesInMemory(Noise(12, 15, 100 + map)), Alternating(12), options);
    ASSERT_TRUE(test.ok());
    found += *std::min_element(test->p_corrected.begin(), test->p_corrected.end()) <= 0.05;
  }
  EXPECT_LE(found, 20);
  EXPECT_GE(found, 2);
}

TEST(GroupTest, IsTheSameEachTime) {
  const ShapesInMemory table(Noise(10, 5, 4));
  EXPECT_EQ(TestGroups(table, Alternating(10))->p, TestGroups(table, Alternating(10))->p);
}

TEST(GroupTest, SaysWhatItExpects) {
  const ShapesInMemory table(Noise(3, 2, 5));
  EXPECT_THAT(TestGroups(table, {0, 1}).status().message(), HasSubstr("2 groups of shapes for 3"));
  EXPECT_THAT(TestGroups(table, {0, 0, 0}).status().message(), HasSubstr("expected 2 to 255"));
  EXPECT_THAT(TestGroups(table, {0, 1, 2}).status().message(), HasSubstr("fewer than shapes"));
}

}  // namespace
}  // namespace ceres_ed
