#include "io_test_util.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/ply_reader.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Returns the error of reading `bytes` as a PLY, without "bad.ply: ".
std::string ErrorOf(const std::string& bytes) {
  const TemporaryDirectory directory;
  const std::string path = directory / "bad.ply";
  WriteBytes(path, bytes);
  const StatusOr<PlyDocument> document = ReadPly(path);
  if (document.ok()) return "no error";
  const std::string message = document.status().message();
  EXPECT_THAT(message, StartsWith(path + ": "));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message.substr(path.size() + 2);
}

std::string Header(const std::string& lines) {
  return "ply\nformat ascii 1.0\n" + lines + "end_header\n";
}

TEST(PlyReader, NamesTheBadLineOfAHeader) {
  EXPECT_EQ(ErrorOf(""), "not a PLY file: the first line is not 'ply'");
  EXPECT_EQ(ErrorOf("solid cube\nfacet\n"), "not a PLY file: the first line is not 'ply'");
  EXPECT_EQ(ErrorOf(std::string(3000, '\0')), "not a PLY file: the first line is not 'ply'");
  EXPECT_EQ(ErrorOf("plywood\nformat ascii 1.0\n"), "not a PLY file: the first line is not 'ply'");
  EXPECT_EQ(ErrorOf("ply\rformat ascii 1.0\r"), "truncated: the header has no line 'end_header'");
  EXPECT_THAT(ErrorOf("ply\rformat ascii 2.0\rend_header\r"), StartsWith("line 2: unknown format"));
  EXPECT_EQ(ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\n"),
            "truncated: the header has no line 'end_header'");
  EXPECT_EQ(ErrorOf("ply\nelement vertex 0\nend_header\n"), "the header has no format line");
  EXPECT_THAT(ErrorOf("ply\nformat binary 1.0\nend_header\n"),
              StartsWith("line 2: unknown format"));
  EXPECT_THAT(ErrorOf("ply\nformat ascii 2.0\nend_header\n"), StartsWith("line 2: unknown format"));
  EXPECT_THAT(ErrorOf(Header("format ascii 1.0\n")), StartsWith("line 3: a second format line"));
  EXPECT_THAT(ErrorOf(Header("elephant\n")), StartsWith("line 3: unknown keyword 'elephant'"));
  EXPECT_THAT(ErrorOf(Header("a\x01z\n")), StartsWith("line 3: unknown keyword 'a?z'"));
  EXPECT_THAT(ErrorOf(Header("property float x\n")), StartsWith("line 3: a property ahead"));
  EXPECT_THAT(ErrorOf(Header("element vertex\n")), StartsWith("line 3: expected 'element NAME"));
}

TEST(PlyReader, NamesTheBadCountOrTypeOfAHeader) {
  EXPECT_EQ(ErrorOf(Header("element vertex -3\n")),
            "line 3: element 'vertex' has the count '-3', expected a whole number of at least 0");
  EXPECT_THAT(ErrorOf(Header("element vertex 1.5\n")), HasSubstr("has the count '1.5'"));
  EXPECT_THAT(ErrorOf(Header("element vertex 99999999999999999999\n")), HasSubstr("has the count"));
  EXPECT_THAT(ErrorOf(Header("element v 1\nproperty long x\n")),
              StartsWith("line 4: property 'x' has the unknown type 'long'"));
  EXPECT_THAT(ErrorOf(Header("element v 1\nproperty list float int x\n")),
              StartsWith("line 4: the lists of property 'x' have the count type 'float'"));
  EXPECT_THAT(ErrorOf(Header("element v 1\nproperty float\n")), StartsWith("line 4: expected"));
  EXPECT_THAT(ErrorOf(Header("element v 1\nproperty int x\nproperty int x\n")),
              StartsWith("line 5: a second property 'x' of element 'v'"));
  EXPECT_THAT(ErrorOf(Header("element v 0\nelement v 0\n")),
              StartsWith("line 4: a second element 'v'"));
  EXPECT_EQ(ErrorOf(Header("element v 1\nproperty int x\v\n")),
            "line 4: 'x?' is no name of a property");
  EXPECT_EQ(ErrorOf(Header("element v 4000000000\n")),
            "element 'v' has 4000000000 rows but no properties");
}

TEST(PlyReader, NamesLineRowAndValueOfABadAsciiNumber) {
  const auto error_of_rows = [](const std::string& rows) {
    return ErrorOf(Header("element vertex 2\nproperty float x\nproperty uchar q\n") + rows);
  };
  EXPECT_EQ(error_of_rows("1 2\n1x 2\n"),
            "line 8: row 1 of element 'vertex': property 'x' is '1x', expected a number");
  EXPECT_EQ(
      error_of_rows("1 300\n1 2\n"),
      "line 7: row 0 of element 'vertex': property 'q' is '300', expected a whole number that "
      "fits its type");
  EXPECT_THAT(error_of_rows("1 -1\n1 2\n"), HasSubstr("'-1'"));
  EXPECT_THAT(error_of_rows("1 2.5\n1 2\n"), HasSubstr("'2.5'"));
  EXPECT_THAT(error_of_rows("1 nan\n1 2\n"), HasSubstr("'nan'"));
  EXPECT_EQ(error_of_rows("1\n1 2\n"),
            "line 7: row 0 of element 'vertex': the line ends ahead of property 'q'");
  EXPECT_EQ(error_of_rows("1 2 3\n1 2\n"),
            "line 7: row 0 of element 'vertex': unexpected '3' behind the last property 'q'");
  EXPECT_EQ(error_of_rows("1 2\n"),
            "truncated: element 'vertex' promises 2 rows, the file ends in row 1");
}

TEST(PlyReader, RefusesBadListLengths) {
  const std::string ascii = Header("element face 1\nproperty list int int i\n");
  EXPECT_THAT(ErrorOf(ascii + "-1 2\n"),
              StartsWith("line 6: row 0 of element 'face': the list 'i' has the length '-1'"));
  EXPECT_THAT(ErrorOf(ascii + "4000000000 2\n"), HasSubstr("the length '4000000000'"));
  EXPECT_THAT(ErrorOf(ascii + "2000000000 2\n"), HasSubstr("the line ends ahead"));
  for (const char* type : {"char", "short", "int"}) {
    std::string bytes = "ply\nformat binary_big_endian 1.0\nelement face 3\nproperty list " +
                        std::string(type) + " uchar i\nend_header\n";
    const std::size_t size = std::strcmp(type, "char") == 0 ? 1 : type[0] == 's' ? 2 : 4;
    bytes += std::string(size, '\0') + std::string(size, '\xff') + "abc";
    EXPECT_EQ(ErrorOf(bytes), "row 1: the list 'i' has a negative length, expected at least 0")
        << type;
  }
}

TEST(PlyReader, NamesTheRowInWhichABinaryFileEnds) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  EXPECT_EQ(ErrorOf(header + std::string(312 * 12 + 5, 'a')),
            "truncated: element 'vertex' promises 1000 rows, the file ends in row 312");
  EXPECT_EQ(ErrorOf(header + std::string(312 * 12 + 11, 'a')),
            "truncated: element 'vertex' promises 1000 rows, the file ends in row 312");
  EXPECT_EQ(ErrorOf(header),
            "truncated: element 'vertex' promises 1000 rows, the file ends in row 0");
  const std::string list =
      "ply\nformat binary_little_endian 1.0\nelement face 3\nproperty list uchar uchar i\n"
      "end_header\n";
  EXPECT_EQ(ErrorOf(list + std::string("\x01"
                                       "a"
                                       "\x03"
                                       "ab",
                                       5)),
            "truncated: element 'face' promises 3 rows, the file ends in row 1");
}

// A list can't be longer than the file, whatever length is given before it.
TEST(PlyReader, NamesTheRowOfAListThatIsLongerThanTheFile) {
  const std::string header =
      "ply\nformat binary_big_endian 1.0\nelement face 3\nproperty short s\n"
      "property list ushort double i\nproperty uchar u\nend_header\n";
  const std::string row = std::string("\0\x07\0\x01", 4) + std::string(8, 'd') + 'u';
  const std::string error = "truncated: element 'face' promises 3 rows, the file ends in row ";
  EXPECT_EQ(ErrorOf(header + row + row + std::string("\0\x07\xff\xff", 4) + std::string(70, 'd')),
            error + "2");
  EXPECT_EQ(ErrorOf(header + row + std::string("\0\x07\0", 3)), error + "1");
  EXPECT_EQ(ErrorOf(header + std::string("\0", 1)), error + "0");
}

// The rows in the header would take 32 GB and more.
TEST(PlyReader, PromisedCountsCostNoMemory) {
  const std::string rows =
      "element vertex 4000000000\nproperty double x\n"
      "element face 18446744073709551615\nproperty list uint int i\nend_header\n";
  struct rusage before;
  getrusage(RUSAGE_SELF, &before);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    EXPECT_THAT(ErrorOf("ply\nformat " + std::string(format) + " 1.0\n" + rows + "1234567\n"),
                StartsWith("truncated: element 'vertex' promises 4000000000 rows"));
  }
  // A list with a length of 4e9 values.
  EXPECT_THAT(ErrorOf("ply\nformat binary_little_endian 1.0\nelement face 1\n"
                      "property list uint int i\nend_header\n\xff\xff\xff\xff"
                      "abcdefgh"),
              StartsWith("truncated: element 'face' promises 1 rows"));
  struct rusage after;
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024) << "kilobytes";
}

TEST(PlyReader, MissingFileAndDirectoryAreErrors) {
  const TemporaryDirectory directory;
  EXPECT_EQ(ReadPly(directory / "none.ply").status().message(),
            directory / "none.ply" + ": cannot read: No such file or directory");
  EXPECT_EQ(ReadPly(directory.path()).status().message(),
            directory.path() + ": is a directory, expected a file");
  EXPECT_THAT(ReadPly("/dev/null").status().message(), HasSubstr("expected a regular file"));
}

// A valid file that is cut at any byte gives an error, or is still complete (if only the last line
// end is missing).
TEST(PlyReader, SurvivesEveryTruncation) {
  const TemporaryDirectory directory;
  for (const Encoding encoding : {Encoding::kAscii, Encoding::kLittle, Encoding::kBig}) {
    for (const bool crlf : {false, true}) {
      const std::string bytes = RichPly(encoding, crlf);
      std::size_t num_whole = 0;
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        WriteBytes(directory / "cut.ply", bytes.substr(0, size));
        const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "cut.ply");
        if (!loaded.ok()) continue;
        ++num_whole;
        EXPECT_EQ(loaded->document.Find("face")->count, 3u);
        EXPECT_EQ(loaded->cloud.triangles.size(), 6u);
      }
      EXPECT_EQ(num_whole, encoding == Encoding::kAscii ? (crlf ? 2u : 1u) : 0u);
    }
  }
}

// If any byte is changed, the result is an error or a document with rows of equal number, never a
// crash.
TEST(PlyReader, SurvivesFlippedBytes) {
  const TemporaryDirectory directory;
  unsigned int random = 99;
  const auto next = [&random] { return (random = random * 1664525u + 1013904223u) >> 8; };
  for (const Encoding encoding : {Encoding::kAscii, Encoding::kLittle, Encoding::kBig}) {
    const std::string bytes = RichPly(encoding, false);
    for (int trial = 0; trial < 1500; ++trial) {
      std::string damaged = bytes;
      for (unsigned int i = 0; i < 1 + next() % 3; ++i) {
        damaged[next() % damaged.size()] = static_cast<char>(next());
      }
      WriteBytes(directory / "damaged.ply", damaged);
      const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "damaged.ply");
      if (!loaded.ok()) {
        EXPECT_FALSE(loaded.status().message().empty());
        continue;
      }
      for (const PlyElement& element : loaded->document.elements) {
        for (const PlyProperty& property : element.properties) {
          EXPECT_EQ(property.is_list ? property.list_sizes.size() : property.values.size(),
                    element.count);
        }
      }
      for (const auto& triangle : loaded->cloud.triangles) {
        for (const int corner : triangle) {
          EXPECT_GE(corner, 0);
          EXPECT_LT(corner, static_cast<int>(loaded->cloud.size()));
        }
      }
    }
  }
}

}  // namespace
}  // namespace ceres_ed
