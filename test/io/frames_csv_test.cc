#include "ceres_ed/io/results/frames_csv.h"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(FramesCsv, ReadsBackAsWritten) {
  const TemporaryDirectory dir;
  FrameRecord first;
  first.number = 7;
  first.status = "tracked";
  first["t_total"] = 0.0123456;
  first["nodes"] = 312;
  first["rms_plane"] = 1.0 / 3.0;
  first["verify_gap"] = std::numeric_limits<double>::quiet_NaN();
  FrameRecord second;
  second.number = 9;
  WriteBytes(dir / "frames.csv", FramesHeader() + FramesRow(first) + FramesRow(second));

  const StatusOr<FrameLog> log = ReadFrameLog(dir / "frames.csv");
  ASSERT_TRUE(log.ok()) << log.status().message();
  EXPECT_THAT(log->frames, ElementsAre(7, 9));
  EXPECT_THAT(log->statuses, ElementsAre("tracked", "skipped"));
  ASSERT_EQ(log->columns.size(), kFrameColumns.size());
  for (std::size_t c = 0; c < kFrameColumns.size(); ++c) {
    EXPECT_EQ(log->columns[c].first, kFrameColumns[c]);
  }
  // Times are rounded to microseconds; everything else is exact.
  EXPECT_EQ((*log->Find("t_total"))[0], 0.012346);
  EXPECT_EQ((*log->Find("nodes"))[0], 312.0);
  EXPECT_EQ((*log->Find("rms_plane"))[0], 1.0 / 3.0);
  EXPECT_TRUE(std::isnan((*log->Find("verify_gap"))[0]));
  EXPECT_EQ(log->Find("nothing"), nullptr);
}

TEST(FramesCsv, NamesTheLineOfABadCell) {
  const TemporaryDirectory dir;
  const auto message = [&dir](const std::string& text) {
    WriteBytes(dir / "frames.csv", text);
    return ReadFrameLog(dir / "frames.csv").status().message();
  };
  EXPECT_THAT(message("frame,t_total\n0,1\n"), HasSubstr("no columns 'frame' and 'status'"));
  EXPECT_THAT(message(""), HasSubstr("no columns 'frame' and 'status'"));
  EXPECT_THAT(message("frame,status,nodes\n0,ok,1\n1,ok\n"),
              HasSubstr("frames.csv: line 3: 2 fields, expected 3"));
  EXPECT_THAT(message("frame,status,nodes\n0,ok,many\n"),
              HasSubstr("frames.csv: line 2: nodes is 'many', expected a number"));
  EXPECT_THAT(message("frame,status\n-1,ok\n"), HasSubstr("line 2: frame is '-1', expected"));
}

}  // namespace
}  // namespace ceres_ed
