#include "ceres_ed/io/sequence/picture_tracks.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

TEST(PictureTracks, ReadsRowsWithAndWithoutAHeader) {
  const TemporaryDirectory dir;
  for (const std::string header : {"", "frame,track,u,v\n", "# by hand\nframe, track, u, v\n"}) {
    WriteBytes(dir / "tracks_2d.csv", header + "0,7,1.5,-2\n\n3, 8, 4, 5  # unsure\n");
    const auto tracks = ReadPictureTracks(dir / "tracks_2d.csv");
    ASSERT_TRUE(tracks.ok()) << tracks.status().message();
    ASSERT_EQ(tracks->size(), 2u);
    EXPECT_EQ((*tracks)[0].track, 7);
    EXPECT_EQ((*tracks)[0].pixel, Eigen::Vector2d(1.5, -2.0));
    EXPECT_EQ((*tracks)[1].frame, 3);
  }
}

TEST(PictureTracks, NamesTheRowThatIsWrong) {
  const TemporaryDirectory dir;
  const auto message = [&dir](const std::string& text) {
    WriteBytes(dir / "tracks_2d.csv", text);
    return ReadPictureTracks(dir / "tracks_2d.csv").status().message();
  };
  EXPECT_THAT(message("0,0,1\n"), HasSubstr("line 1: 3 fields, expected 4"));
  EXPECT_THAT(message("0,0,1,2\n0,0,3,4\n"), HasSubstr("line 2: track 0 is there twice"));
  EXPECT_THAT(message("0,0,1,nan\n"), HasSubstr("v is 'nan', expected a finite number of pixels"));
  EXPECT_THAT(message("0.5,0,1,2\n"), HasSubstr("line 1: frame is '0.5'"));
}

}  // namespace
}  // namespace ceres_ed
