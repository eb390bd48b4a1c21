#include "small_fit.h"

#include <ceres_ed/report/html/base64.h>
#include <ceres_ed/report/html/scene_data.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;

// The examples of RFC 4648, section 10.
TEST(Base64, AgreesWithTheStandard) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xFF\xFE\xFD"), "//79");
}

TEST(Base64, NumbersAreLittleEndian) {
  EXPECT_EQ(Base64OfUint16({0x6f66, 0x626f}), "Zm9vYg==");
  EXPECT_EQ(Base64OfUint32({0x626f6f66}), "Zm9vYg==");
  EXPECT_EQ(Base64OfDoubles({1.0}), Base64(std::string("\0\0\0\0\0\0\xF0\x3F", 8)));
}

TEST(Quantize, HasTheEndsOfTheRangeAndTheUnknown) {
  EXPECT_THAT(Quantize({-1.0, 1.0, 0.0, 7.0, -7.0, std::nan("")}, -1.0, 1.0),
              ElementsAre(0, 65534, 32767, 65534, 0, kUnknownStep));
  EXPECT_THAT(Quantize({2.0}, 2.0, 2.0), ElementsAre(0));
}

TEST(Quantize, PointsAreAtMostHalfAStepAway) {
  std::vector<Eigen::Vector3d> points;
  Eigen::AlignedBox3d box;
  for (int i = 0; i < 1000; ++i) {
    points.emplace_back(std::sin(i), 1e5 + 10.0 * std::cos(3.0 * i), 5.0);
    box.extend(points.back());
  }
  const std::vector<std::uint16_t> steps = QuantizePoints(points, box);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double side = box.max()[axis] - box.min()[axis];
      const double at = box.min()[axis] + steps[3 * i + axis] / 65535.0 * side;
      EXPECT_NEAR(at, points[i][axis], 0.5001 * side / 65535.0 + 1e-10);
    }
  }
}

TEST(SceneData, HasWhatTheViewReads) {
  const FitView view = MakeFitView(MakeSmallFit().Parts());
  const nlohmann::ordered_json data = SceneData(view.scene);
  EXPECT_EQ(data["panels"].size(), 3U);
  EXPECT_EQ(data["surfaces"].size(), 2U);
  const auto& source = data["surfaces"][0];
  EXPECT_FALSE(source["motion"].is_null());
  EXPECT_TRUE(data["surfaces"][1]["motion"].is_null());
  EXPECT_EQ(source["faces"]["bits"], 16);
  // 144 points of three numbers of two bytes.
  EXPECT_EQ(source["points"]["steps"].get<std::string>().size(), 144U * 3 * 2 / 3 * 4);
  const auto& field = source["fields"][0];
  EXPECT_EQ(field["key"], "distance");
  EXPECT_EQ(field["high"], view.scene.surfaces[0].fields[0].range.high);
}

TEST(SceneData, RowsBeyond16BitsHave32) {
  Scene scene;
  std::vector<int> kept;
  std::vector<int> rows(16, 0);
  rows[15] = 70000;
  scene.surfaces.push_back(MakeViewSurface("points", SquareCloud(4), rows, 1000, {}, &kept));
  EXPECT_EQ(SceneData(scene)["surfaces"][0]["rows"]["bits"], 32);
}

TEST(SceneData, AnEmptySceneIsData) { EXPECT_TRUE(SceneData(Scene())["surfaces"].empty()); }

}  // namespace
}  // namespace ceres_ed
