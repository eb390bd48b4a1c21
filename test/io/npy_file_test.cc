#include "ceres_ed/io/npy_file.h"

#include "io_test_util.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Returns a file as numpy writes it.
std::string Npy(const std::string& header, const std::string& numbers) {
  std::string bytes("\x93NUMPY\1\0", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  return bytes + header + numbers;
}

class NpyFiles : public ::testing::Test {
 protected:
  StatusOr<NpyArray> Read(const std::string& bytes) {
    WriteBytes(folder_ / "a.npy", bytes);
    return ReadNpyFile(folder_ / "a.npy");
  }
  std::string Error(const std::string& bytes) {
    const StatusOr<NpyArray> array = Read(bytes);
    return array.ok() ? "no error" : array.status().message().substr(folder_.path().size());
  }

  TemporaryDirectory folder_;
};

TEST_F(NpyFiles, NumbersOfSeveralTypesAreRead) {
  const std::string shape = ", 'fortran_order': False, 'shape': (2,), }\n";
  auto array = Read(Npy("{'descr': '<u2'" + shape, std::string("\x01\x00\xFF\xFF", 4)));
  ASSERT_TRUE(array.ok()) << array.status().message();
  EXPECT_THAT(array->values, ElementsAre(1, 65535));
  EXPECT_THAT(array->shape, ElementsAre(2));
  array = Read(Npy("{'descr': '<i4'" + shape, std::string("\xFE\xFF\xFF\xFF\x07\x00\x00\x00", 8)));
  ASSERT_TRUE(array.ok()) << array.status().message();
  EXPECT_THAT(array->values, ElementsAre(-2, 7));
  array = Read(Npy("{'descr': '>f4'" + shape, std::string("\x3F\x80\x00\x00\xC0\x00\x00\x00", 8)));
  ASSERT_TRUE(array.ok()) << array.status().message();
  EXPECT_THAT(array->values, ElementsAre(1.0, -2.0));
}

TEST_F(NpyFiles, FortranOrderIsTurnedIntoC) {
  // [[1, 2, 3], [4, 5, 6]] column by column.
  const auto array = Read(Npy("{'descr': '|u1', 'fortran_order': True, 'shape': (2, 3), }\n",
                              std::string("\1\4\2\5\3\6", 6)));
  ASSERT_TRUE(array.ok()) << array.status().message();
  EXPECT_THAT(array->values, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(NpyFiles, WrittenArraysAreReadBack) {
  NpyArray array;
  array.shape = {2, 2};
  array.values = {0.1, -3.0, 1e300, 7.0};
  ASSERT_TRUE(WriteNpyFile(folder_ / "b.npy", array).ok());
  auto back = ReadNpyFile(folder_ / "b.npy");
  ASSERT_TRUE(back.ok()) << back.status().message();
  EXPECT_EQ(back->values, array.values);
  EXPECT_EQ(back->shape, array.shape);
  array.values = {0.5, 0.25, 1.0, 2.0};
  ASSERT_TRUE(WriteNpyFileAsFloat(folder_ / "b.npy", array).ok());
  back = ReadNpyFile(folder_ / "b.npy");
  ASSERT_TRUE(back.ok()) << back.status().message();
  EXPECT_EQ(back->values, array.values);
}

TEST_F(NpyFiles, DamagedFilesAreErrors) {
  EXPECT_THAT(Error("PNG"), HasSubstr("does not begin with the mark of numpy"));
  EXPECT_EQ(Error(Npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n", "12345678")),
            "/a.npy: 8 bytes of numbers, expected 16 for the shape (2,)");
  EXPECT_EQ(Error(Npy("{'descr': '<c8', 'fortran_order': False, 'shape': (1,), }\n", "12345678")),
            "/a.npy: the type is '<c8', expected floats of 32 or 64 bits or integers");
  EXPECT_THAT(Error(Npy("{'descr': '<f8', 'shape': (99999999999999999999999,), }\n", "")),
              HasSubstr("the shape has '999"));
  EXPECT_THAT(Error(Npy("{'descr': '<f8', 'shape': (65536, 65536, 65536, 65536, 65536), }\n", "")),
              HasSubstr("the shape is (65536, "));
  EXPECT_THAT(Error(Npy("{'shape': (1,), }\n", "")), HasSubstr("names no type"));
  EXPECT_THAT(Error(Npy("{'descr': '<f8'}", "")), HasSubstr("no shape"));
  std::string cut = Npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n", "");
  cut.resize(20);
  EXPECT_THAT(Error(cut), HasSubstr("the header is cut off"));
}

}  // namespace
}  // namespace ceres_ed
