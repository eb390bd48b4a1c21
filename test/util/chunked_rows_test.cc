#include "ceres_ed/util/chunked_rows.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(ChunkedRows, KeepsRowsWhereTheyAreWhenItGrows) {
  ChunkedRows<int> rows(3);
  EXPECT_EQ(rows.width(), 3);
  rows.Resize(1);
  int* first = rows[0];
  first[2] = 7;
  for (int size = 2; size < 2000; ++size) {
    rows.Resize(size);
    rows[size - 1][0] = size;
  }
  EXPECT_EQ(rows[0], first);
  EXPECT_EQ(rows[0][2], 7);
  for (int row = 1; row < 1999; ++row) {
    EXPECT_EQ(rows[row][0], row + 1);
    EXPECT_EQ(rows[row][1], 0);
  }
}

TEST(ChunkedRows, FillsNewRowsAnewAfterItShrank) {
  ChunkedRows<double> rows(2);
  rows.Resize(300);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row][1] = 5.0;
  rows.Resize(10);
  EXPECT_EQ(rows.size(), 10u);
  rows.Resize(300);
  EXPECT_EQ(rows[9][1], 5.0);
  EXPECT_EQ(rows[10][1], 0.0);
  EXPECT_EQ(rows[299][1], 0.0);
}

TEST(ChunkedRows, CopiesItsRows) {
  ChunkedRows<int> rows(1);
  rows.Resize(400);
  *rows[399] = 1;
  ChunkedRows<int> copy = rows;
  *rows[399] = 2;
  EXPECT_EQ(*copy[399], 1);
}

}  // namespace
}  // namespace ceres_ed
