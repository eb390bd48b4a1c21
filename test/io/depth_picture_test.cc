// Depth in the forms of data sets: TIFF and arrays of numpy.
#include "ceres_ed/io/image_io.h"
#include "io_test_util.h"

#include <ceres_ed/io/npy_file.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Returns an uncompressed TIFF in little endian with one row of pixels.
std::string Tiff(int width, int channels, int bits, bool is_float, const std::string& pixels) {
  std::string bytes("II*\0\x08\0\0\0", 8);
  const auto put = [&bytes](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
  };
  constexpr int kShort = 3;
  constexpr int kLong = 4;
  const auto entry = [&put](int tag, int type, int count, std::uint32_t value) {
    put(static_cast<std::uint32_t>(tag), 2);
    put(static_cast<std::uint32_t>(type), 2);
    put(static_cast<std::uint32_t>(count), 4);
    put(value, 4);
  };
  constexpr int kEntries = 10;
  const std::uint32_t extra = 8 + 2 + kEntries * 12 + 4;
  const auto unsigned_channels = static_cast<std::uint32_t>(channels);
  const auto unsigned_bits = static_cast<std::uint32_t>(bits);
  const std::uint32_t lists = channels == 1 ? 0 : 2 * unsigned_channels;
  put(kEntries, 2);
  entry(256, kLong, 1, static_cast<std::uint32_t>(width));
  entry(257, kLong, 1, 1);
  entry(258, kShort, channels, channels == 1 ? unsigned_bits : extra);
  entry(259, kShort, 1, 1);
  entry(262, kShort, 1, channels == 1 ? 1 : 2);
  entry(273, kLong, 1, extra + 2 * lists);
  entry(277, kShort, 1, unsigned_channels);
  entry(278, kLong, 1, 1);
  entry(279, kLong, 1, static_cast<std::uint32_t>(pixels.size()));
  const std::uint32_t format = is_float ? 3 : 1;
  entry(339, kShort, channels, channels == 1 ? format : extra + lists);
  put(0, 4);
  if (channels > 1) {
    for (int i = 0; i < channels; ++i) put(unsigned_bits, 2);
    for (int i = 0; i < channels; ++i) put(format, 2);
  }
  return bytes + pixels;
}

template <typename T>
std::string Bytes(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

class DepthPictures : public ::testing::Test {
 protected:
  StatusOr<DepthImage> Read(const std::string& bytes, double units_per_metre) {
    WriteBytes(folder_ / "depth.tiff", bytes);
    return ReadDepthImage(folder_ / "depth.tiff", units_per_metre, &saturated_);
  }

  TemporaryDirectory folder_;
  int saturated_ = 0;
};

TEST_F(DepthPictures, DepthIsTheThirdOfThreeFloats) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto depth =
      Read(Tiff(3, 3, 32, true, Bytes<float>({1, 2, 50, kNan, kNan, kNan, -4, 5, 125})), 1000.0);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  EXPECT_THAT(depth->pixels(), ElementsAre(0.05F, 0.0F, 0.125F));
}

TEST_F(DepthPictures, SixteenBitsOfTiffAreScaled) {
  const auto depth =
      Read(Tiff(4, 1, 16, false, Bytes<std::uint16_t>({0, 13107, 32768, 65535})), 655350.0);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  EXPECT_THAT(depth->pixels(),
              ElementsAre(0.0F, 0.02F, static_cast<float>(32768.0 / 655350.0), 0.0F));
  EXPECT_EQ(saturated_, 1);
}

TEST_F(DepthPictures, OneFloatIsDepth) {
  const auto depth = Read(Tiff(3, 1, 32, true, Bytes<float>({0.5F, -1.0F, INFINITY})), 1.0);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  EXPECT_THAT(depth->pixels(), ElementsAre(0.5F, 0.0F, 0.0F));
}

TEST_F(DepthPictures, ArraysOfNumpyAreDepth) {
  NpyArray array;
  array.shape = {2, 3};
  array.values = {0.1, 0.2, NAN, 0.0, -1.0, INFINITY};
  ASSERT_TRUE(WriteNpyFileAsFloat(folder_ / "depth.npy", array).ok());
  const auto depth = ReadDepthImage(folder_ / "depth.npy", 1.0);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  EXPECT_EQ(depth->width(), 3);
  EXPECT_THAT(depth->pixels(), ElementsAre(0.1F, 0.2F, 0.0F, 0.0F, 0.0F, 0.0F));
  array.shape = {6};
  ASSERT_TRUE(WriteNpyFile(folder_ / "depth.npy", array).ok());
  EXPECT_THAT(ReadDepthImage(folder_ / "depth.npy", 1.0).status().message(),
              HasSubstr("the shape is (6,), expected depth as (height, width)"));
}

TEST_F(DepthPictures, WrittenTiffsAreReadBack) {
  const PinholeCamera camera = {100, 100, 1, 0.5, 3, 2};
  DepthImage depth(3, 2, 0.25F);
  depth(1, 0) = 0.0F;
  ASSERT_TRUE(WritePointImage(folder_ / "points.tiff", camera, depth, 1000.0).ok());
  auto back = ReadDepthImage(folder_ / "points.tiff", 1000.0);
  ASSERT_TRUE(back.ok()) << back.status().message();
  EXPECT_EQ(back->pixels(), depth.pixels());
  ASSERT_TRUE(WriteDepthImage(folder_ / "d.tiff", depth, 200000.0).ok());
  back = ReadDepthImage(folder_ / "d.tiff", 200000.0);
  ASSERT_TRUE(back.ok()) << back.status().message();
  EXPECT_EQ(back->pixels(), depth.pixels());
  EXPECT_EQ(ReadBytes(folder_ / "d.tiff").substr(0, 2), "II");
}

}  // namespace
}  // namespace ceres_ed
