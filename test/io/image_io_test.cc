#include "ceres_ed/io/image_io.h"

#include "io_test_util.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// PNGs made by hand with zlib: grey 3 x 1 with 8 bits (0 7 255), grey 4 x 1 with 16 bits (0 1 258
// 65535), red-green-blue 1 x 1 with 16 bits.
constexpr char kGrey8[] =
    "89504e470d0a1a0a0000000d49484452000000030000000108000000003e8b4b680000000c4944415478da6360"
    "60ff0f00011101077215cd730000000049454e44ae426082";
constexpr char kGrey16[] =
    "89504e470d0a1a0a0000000d49484452000000040000000110000000008cc78c52000000114944415478da6360"
    "6060606464faff1f00031502034e153b4c0000000049454e44ae426082";
constexpr char kColor16[] =
    "89504e470d0a1a0a0000000d4948445200000001000000011002000000c0e78f9d0000000f4944415478da6360"
    "64626661650300003f001698c168130000000049454e44ae426082";

std::string FromHex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

class Images : public ::testing::Test {
 protected:
  TemporaryDirectory directory_;
  std::string path_ = directory_ / "image.png";
};

TEST_F(Images, DepthOf16BitsIsUnitsInMetres) {
  WriteBytes(path_, FromHex(kGrey16));
  int saturated = -1;
  const StatusOr<DepthImage> depth = ReadDepthImage(path_, 1000.0, &saturated);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  EXPECT_EQ(depth->width(), 4);
  EXPECT_EQ(depth->height(), 1);
  // The largest number is no depth.
  EXPECT_THAT(depth->pixels(), ElementsAre(0.0F, 0.001F, 0.258F, 0.0F));
  EXPECT_EQ(saturated, 1);
}

TEST_F(Images, DepthOf8BitsIsUnitsInMetres) {
  WriteBytes(path_, FromHex(kGrey8));
  const StatusOr<DepthImage> depth = ReadDepthImage(path_, 100.0);
  ASSERT_TRUE(depth.ok()) << depth.status().message();
  EXPECT_THAT(depth->pixels(), ElementsAre(0.0F, 0.07F, 2.55F));
}

TEST_F(Images, DepthOfEveryUnitSurvivesTheRoundTrip) {
  // All numbers but the largest, with units below and above those of real sensors.
  for (const double units_per_metre : {1000.0, 5000.0, 100000.0}) {
    DepthImage written(256, 256);
    for (int v = 0; v < 256; ++v) {
      for (int u = 0; u < 256; ++u) {
        written(u, v) = static_cast<float>(std::min(65534, 256 * v + u) / units_per_metre);
      }
    }
    ASSERT_TRUE(WriteDepthImage(path_, written, units_per_metre).ok());
    const StatusOr<DepthImage> read = ReadDepthImage(path_, units_per_metre);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->width(), 256);
    EXPECT_EQ(read->pixels(), written.pixels()) << units_per_metre;
  }
}

TEST_F(Images, DepthIsRoundedAndWhatDoesNotFitIsNone) {
  DepthImage written(8, 1);
  written.pixels() = {0.0014F,
                      0.0016F,
                      0.0004F,
                      -1.0F,
                      std::numeric_limits<float>::quiet_NaN(),
                      std::numeric_limits<float>::infinity(),
                      65.534F,
                      65.535F};
  ASSERT_TRUE(WriteDepthImage(path_, written, 1000.0).ok());
  const StatusOr<DepthImage> read = ReadDepthImage(path_, 1000.0);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_THAT(read->pixels(), ElementsAre(0.001F, 0.002F, 0.0F, 0.0F, 0.0F, 0.0F, 65.534F, 0.0F));
}

TEST_F(Images, ColorSurvivesTheRoundTripWithItsChannelsInOrder) {
  ColorImage written(2, 3);
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 2; ++u) {
      written(u, v) = {
          static_cast<std::uint8_t>(10 * v + u), static_cast<std::uint8_t>(100 + v), 255};
    }
  }
  ASSERT_TRUE(WriteColorImage(path_, written).ok());
  const StatusOr<ColorImage> read = ReadColorImage(path_);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->width(), 2);
  EXPECT_EQ(read->pixels(), written.pixels());
}

TEST_F(Images, GreyPictureIsColorWithEqualChannels) {
  WriteBytes(path_, FromHex(kGrey8));
  const StatusOr<ColorImage> color = ReadColorImage(path_);
  ASSERT_TRUE(color.ok()) << color.status().message();
  using Rgb = std::array<std::uint8_t, 3>;
  EXPECT_THAT(color->pixels(), ElementsAre(Rgb{0, 0, 0}, Rgb{7, 7, 7}, Rgb{255, 255, 255}));
}

TEST_F(Images, MaskIsWhatIsNotBlack) {
  WriteBytes(path_, FromHex(kGrey8));
  const StatusOr<MaskImage> grey = ReadMaskImage(path_);
  ASSERT_TRUE(grey.ok()) << grey.status().message();
  EXPECT_THAT(grey->pixels(), ElementsAre(0, 1, 1));
  ColorImage color(2, 1);
  color(1, 0) = {0, 0, 1};
  ASSERT_TRUE(WriteColorImage(path_, color).ok());
  const StatusOr<MaskImage> blue = ReadMaskImage(path_);
  ASSERT_TRUE(blue.ok()) << blue.status().message();
  EXPECT_THAT(blue->pixels(), ElementsAre(0, 1));
}

TEST_F(Images, ColoursAreNoDepth) {
  ASSERT_TRUE(WriteColorImage(path_, ColorImage(2, 2)).ok());
  EXPECT_EQ(ReadDepthImage(path_, 1000.0).status().message(),
            path_ + ": 3 channels of 8 bits, expected depth as one channel of 16 bits");
  WriteBytes(path_, FromHex(kColor16));
  EXPECT_EQ(ReadDepthImage(path_, 1000.0).status().message(),
            path_ + ": 3 channels of 16 bits, expected depth as one channel of 16 bits");
}

TEST_F(Images, MissingOrDamagedFileIsAnErrorThatNamesIt) {
  const std::string whole = FromHex(kGrey16);
  std::string changed = whole;
  changed[45] = static_cast<char>(changed[45] ^ 0x55);  // Inside the compressed rows.
  for (const std::string& bytes : {std::string(),
                                   std::string("no picture"),
                                   whole.substr(0, 20),
                                   whole.substr(0, 48),
                                   changed}) {
    WriteBytes(path_, bytes);
    EXPECT_THAT(ReadDepthImage(path_, 1000.0).status().message(), HasSubstr(path_ + ": "))
        << bytes.size();
    EXPECT_THAT(ReadColorImage(path_).status().message(), HasSubstr(path_ + ": "));
    EXPECT_THAT(ReadMaskImage(path_).status().message(), HasSubstr(path_ + ": "));
  }
  const std::string missing = directory_ / "none.png";
  EXPECT_THAT(ReadDepthImage(missing, 1000.0).status().message(), HasSubstr(missing + ": "));
  EXPECT_THAT(ReadColorImage(directory_.path()).status().message(), HasSubstr(directory_.path()));
}

TEST_F(Images, PngThatIsCutOffIsAnErrorAndNothingElseIsPrinted) {
  const std::string whole = FromHex(kGrey16);
  for (const std::size_t size : {whole.size() - 1, whole.size() - 12, std::size_t(40)}) {
    WriteBytes(path_, whole.substr(0, size));
    ::testing::internal::CaptureStderr();
    const Status status = ReadDepthImage(path_, 1000.0).status();
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_THAT(status.message(), HasSubstr("ends after " + std::to_string(size) + " bytes"));
  }
}

// Otherwise the decoder would fill gigabytes before it misses the data.
TEST_F(Images, AHeaderThatPromisesMoreThanTheFileCanHoldIsAnError) {
  std::string png = FromHex(kGrey16);
  // Width and height: 8192 x 8192 of 16 bits are 128 MB, of which 74 bytes hold at most 76 kB.
  png.replace(16, 8, std::string("\0\0\x20\0\0\0\x20\0", 8));
  WriteBytes(path_, png);
  EXPECT_EQ(ReadDepthImage(path_, 1000.0).status().message(),
            path_ +
                ": its header promises 8192 x 8192 pixels, which 74 bytes cannot hold: it is "
                "damaged, or was not written whole");
  png.replace(16, 8, std::string("\0\0\x80\0\0\0\x80\0", 8));
  WriteBytes(path_, png);
  EXPECT_THAT(ReadColorImage(path_).status().message(),
              HasSubstr("32768 x 32768 pixels, expected at most 8192 x 8192 of them"));
  // JFIF, then a frame of 8000 x 8000 pixels of one component.
  WriteBytes(path_,
             FromHex("ffd8ffe000104a46494600010100000100010000ffc0000b081f401f4001011100ffd9"));
  EXPECT_THAT(ReadMaskImage(path_).status().message(),
              HasSubstr("promises 8000 x 8000 pixels, which 35 bytes cannot hold"));
  // A TIFF whose only two tags are width and height, big-endian.
  WriteBytes(path_,
             FromHex("4d4d002a000000080002010000040000000100100000010100040000000100100000"
                     "00000000"));
  EXPECT_THAT(ReadDepthImage(path_, 1000.0).status().message(),
              HasSubstr("promises 1048576 x 1048576 pixels"));
}

TEST_F(Images, ABlankPictureIsRead) {
  const ColorImage blank(4000, 3000, {0, 0, 0});
  ASSERT_TRUE(WriteColorImage(path_, blank).ok());
  const StatusOr<ColorImage> read = ReadColorImage(path_);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->width(), 4000);
}

TEST_F(Images, UnwritablePathIsAnErrorThatNamesIt) {
  const std::string path = directory_ / "none/depth.png";
  EXPECT_THAT(WriteDepthImage(path, DepthImage(2, 2, 1.0F), 1000.0).message(), HasSubstr(path));
  EXPECT_THAT(WriteColorImage(path, ColorImage(2, 2)).message(), HasSubstr(path));
}

}  // namespace
}  // namespace ceres_ed
