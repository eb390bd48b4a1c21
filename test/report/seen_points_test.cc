#include <ceres_ed/report/view/seen_points.h>

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A grid of 21 x 21 points at the height z, with triangles, of the size `scale`.
PointCloud Sheet(double z, double scale, int columns = 21) {
  constexpr int kRows = 21;
  PointCloud cloud;
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < columns; ++x) {
      cloud.points.emplace_back(scale * x / 20.0, scale * y / 20.0, scale * z);
    }
  }
  for (int y = 0; y + 1 < kRows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const int at = y * columns + x;
      cloud.triangles.push_back({at, at + 1, at + columns});
      cloud.triangles.push_back({at + 1, at + columns + 1, at + columns});
    }
  }
  return cloud;
}

int CountNotShown(const PointCloud& result, const PointCloud& target) {
  const std::vector<char> not_shown = PointsNotShown(result, target);
  return std::accumulate(not_shown.begin(), not_shown.end(), 0);
}

TEST(PointsNotShown, AreNoneOnAWholeTarget) {
  EXPECT_EQ(CountNotShown(Sheet(0.02, 1.0), Sheet(0.0, 1.0)), 0);
}

TEST(PointsNotShown, AreThoseBeyondTheReachOfAHalf) {
  // The half has the columns 0 to 10, and its points reach two columns farther.
  EXPECT_EQ(CountNotShown(Sheet(0.02, 1.0), Sheet(0.0, 1.0, 11)), 21 * (20 - 12));
}

TEST(PointsNotShown, AreTheFarSideOfABody) {
  PointCloud body = Sheet(0.0, 1.0);
  const PointCloud back = Sheet(0.5, 1.0);
  const int offset = static_cast<int>(body.size());
  body.points.insert(body.points.end(), back.points.begin(), back.points.end());
  for (const auto& t : back.triangles) {
    body.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  const std::vector<char> not_shown = PointsNotShown(body, Sheet(-0.02, 1.0));
  for (int i = 0; i < 2 * offset; ++i) EXPECT_EQ(not_shown[i], i < offset ? 0 : 1) << i;
}

TEST(PointsNotShown, DoNotDependOnTheUnit) {
  EXPECT_EQ(PointsNotShown(Sheet(0.02, 1.0), Sheet(0.0, 1.0, 11)),
            PointsNotShown(Sheet(0.02, 1000.0), Sheet(0.0, 1000.0, 11)));
}

}  // namespace
}  // namespace ceres_ed
