// Landmarks on some pieces of a source carry the pieces between them.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>

#include <cmath>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

constexpr int kSide = 16;
constexpr int kSheets = 4;

// A smooth map of space that bends by several per cent of the sheets' extent.
Eigen::Vector3d Bent(const Eigen::Vector3d& point) {
  return point + Eigen::Vector3d(0.4 * std::sin(0.3 * point.y()),
                                 0.0,
                                 0.8 * std::sin(0.35 * point.x() + 0.1 * point.y()));
}

TEST(CarriedPieces, FollowTheSheetsAboveAndBelow) {
  FitInput input;
  for (int sheet = 0; sheet < kSheets; ++sheet) {
    const int first = static_cast<int>(input.source.size());
    for (const Eigen::Vector3d& point : MakeGridMesh(kSide, kSide).points) {
      input.source.points.push_back(point + Eigen::Vector3d(0.0, 0.0, 0.2 * sheet));
    }
    for (const auto& t : MakeGridMesh(kSide, kSide).triangles) {
      input.source.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  const int size = kSide * kSide;
  for (const int sheet : {0, kSheets - 1}) {
    for (int p = 0; p < size; p += 3) {
      const int point = sheet * size + p;
      input.landmarks.push_back({point, Bent(input.source.points[point])});
    }
  }
  const StatusOr<FitResult> result = Fit(input, FitOptions(), BuiltinEnergies());
  ASSERT_TRUE(result.ok()) << result.status().message();
  double between = 0.0;
  double rigid = 0.0;
  for (int p = size; p < 3 * size; ++p) {
    const Eigen::Vector3d truth = Bent(input.source.points[p]);
    between += (result->points[p] - truth).norm();
    rigid += (result->rigid * input.source.points[p] - truth).norm();
  }
  EXPECT_LT(between, 0.25 * rigid);
}

}  // namespace
}  // namespace ceres_ed
