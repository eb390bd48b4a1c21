#include "io_test_util.h"

#include <ceres_ed/io/mesh/ply_reader.h>
#include <ceres_ed/io/mesh/ply_writer.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;

void ExpectSameDocument(const PlyDocument& a, const PlyDocument& b) {
  EXPECT_EQ(a.comments, b.comments);
  EXPECT_EQ(a.obj_info, b.obj_info);
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t e = 0; e < a.elements.size(); ++e) {
    EXPECT_EQ(a.elements[e].name, b.elements[e].name);
    EXPECT_EQ(a.elements[e].count, b.elements[e].count);
    ASSERT_EQ(a.elements[e].properties.size(), b.elements[e].properties.size());
    for (std::size_t p = 0; p < a.elements[e].properties.size(); ++p) {
      const PlyProperty& left = a.elements[e].properties[p];
      const PlyProperty& right = b.elements[e].properties[p];
      EXPECT_EQ(left.name, right.name);
      EXPECT_EQ(left.type, right.type);
      EXPECT_EQ(left.is_list, right.is_list);
      EXPECT_EQ(left.list_count_type, right.list_count_type);
      EXPECT_EQ(left.values, right.values) << left.name;
      EXPECT_EQ(left.list_sizes, right.list_sizes) << left.name;
    }
  }
}

class PlyRoundTrip : public ::testing::TestWithParam<std::tuple<Encoding, bool>> {
 protected:
  Encoding encoding() const { return std::get<0>(GetParam()); }
  bool crlf() const { return std::get<1>(GetParam()); }
  TemporaryDirectory directory_;
};

TEST_P(PlyRoundTrip, ReadsEveryTypeElementAndComment) {
  WriteBytes(directory_ / "in.ply", RichPly(encoding(), crlf()));
  const StatusOr<PlyDocument> document = ReadPly(directory_ / "in.ply");
  ASSERT_TRUE(document.ok()) << document.status().message();
  EXPECT_THAT(document->comments, ElementsAre("first  with  blanks ", ""));
  EXPECT_THAT(document->obj_info, ElementsAre("scanner 7"));
  ASSERT_EQ(document->elements.size(), 4u);

  const PlyElement& vertices = document->elements[0];
  EXPECT_EQ(vertices.name, "vertex");
  ASSERT_EQ(vertices.count, 5u);
  ASSERT_EQ(vertices.properties.size(), 10u);
  EXPECT_THAT(vertices.Find("x")->values, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(vertices.Find("x")->type, PlyType::kFloat32);
  EXPECT_THAT(vertices.Find("y")->values, ElementsAre(0, 0.5, 1, 1.5, 2));
  EXPECT_EQ(vertices.Find("y")->type, PlyType::kFloat64);
  EXPECT_THAT(vertices.Find("red")->values, ElementsAre(200, 201, 202, 203, 204));
  EXPECT_EQ(vertices.Find("tiny")->values[4], -128);
  EXPECT_EQ(vertices.Find("s")->values[4], -32768);
  EXPECT_EQ(vertices.Find("us")->values[4], 65535);
  EXPECT_EQ(vertices.Find("label")->values[4], -2147483648.0);
  EXPECT_EQ(vertices.Find("id")->values[4], 4294967295.0);
  EXPECT_EQ(vertices.Find("quality")->values[4], 1.0 / 7.0);
  EXPECT_EQ(vertices.properties[9].name, "quality");

  const PlyElement& cameras = document->elements[1];
  EXPECT_THAT(cameras.Find("rays")->list_sizes, ElementsAre(2, 0));
  EXPECT_THAT(cameras.Find("rays")->values, ElementsAre(0.1f, 1e-30f));
  EXPECT_EQ(cameras.Find("rays")->list_count_type, PlyType::kUint16);
  EXPECT_THAT(cameras.Find("f")->values, ElementsAre(1e300, -0.25));
  const PlyElement& faces = document->elements[2];
  EXPECT_THAT(faces.Find("vertex_indices")->list_sizes, ElementsAre(4, 5, 3));
  EXPECT_THAT(faces.Find("vertex_indices")->values,
              ElementsAre(0, 1, 2, 3, 0, 1, 2, 3, 4, 4, 3, 2));
  EXPECT_THAT(faces.Find("flag")->values, ElementsAre(9, 9, 9));
  EXPECT_EQ(document->elements[3].name, "nothing");
}

TEST_P(PlyRoundTrip, WritingKeepsEverythingAndTheFormat) {
  WriteBytes(directory_ / "in.ply", RichPly(encoding(), crlf()));
  const StatusOr<PlyDocument> document = ReadPly(directory_ / "in.ply");
  ASSERT_TRUE(document.ok());
  ASSERT_TRUE(WritePly(directory_ / "out.ply", *document).ok());
  const StatusOr<PlyDocument> again = ReadPly(directory_ / "out.ply");
  ASSERT_TRUE(again.ok()) << again.status().message();
  EXPECT_EQ(document->format, again->format);
  ExpectSameDocument(*document, *again);
  EXPECT_NE(ReadBytes(directory_ / "out.ply").find(FormatWord(encoding())), std::string::npos);
}

TEST_P(PlyRoundTrip, BinaryBodyIsWrittenByteForByte) {
  if (encoding() == Encoding::kAscii) GTEST_SKIP() << "digits may differ";
  const std::string bytes = RichPly(encoding(), crlf());
  WriteBytes(directory_ / "in.ply", bytes);
  const StatusOr<PlyDocument> document = ReadPly(directory_ / "in.ply");
  ASSERT_TRUE(document.ok());
  ASSERT_TRUE(WritePly(directory_ / "out.ply", *document).ok());
  const std::string written = ReadBytes(directory_ / "out.ply");
  const auto body = [](const std::string& file) {
    return file.substr(file.find('\n', file.find("end_header")) + 1);
  };
  EXPECT_EQ(body(written), body(bytes));
}

TEST_P(PlyRoundTrip, EveryFormatConvertsToEveryOther) {
  WriteBytes(directory_ / "in.ply", RichPly(encoding(), crlf()));
  StatusOr<PlyDocument> document = ReadPly(directory_ / "in.ply");
  ASSERT_TRUE(document.ok());
  for (const PlyFormat format :
       {PlyFormat::kAscii, PlyFormat::kBinaryLittleEndian, PlyFormat::kBinaryBigEndian}) {
    document->format = format;
    ASSERT_TRUE(WritePly(directory_ / "out.ply", *document).ok());
    const StatusOr<PlyDocument> again = ReadPly(directory_ / "out.ply");
    ASSERT_TRUE(again.ok()) << again.status().message();
    ExpectSameDocument(*document, *again);
  }
}

INSTANTIATE_TEST_SUITE_P(
    AllEncodings,
    PlyRoundTrip,
    ::testing::Combine(::testing::Values(Encoding::kAscii, Encoding::kLittle, Encoding::kBig),
                       ::testing::Bool()));

TEST(PlyWriter, AsciiNumbersReadBackToTheSameBits) {
  const TemporaryDirectory directory;
  PlyDocument document;
  document.format = PlyFormat::kAscii;
  PlyElement element;
  element.name = "vertex";
  PlyProperty floats = MakePlyScalar("f", PlyType::kFloat32);
  PlyProperty doubles = MakePlyScalar("d", PlyType::kFloat64);
  unsigned int random = 12345;
  for (int i = 0; i < 2000; ++i) {
    random = random * 1664525u + 1013904223u;
    // The magnitudes cover the whole range of float, subnormal ones included.
    const double value =
        std::ldexp(static_cast<double>(random) / 4294967296.0 - 0.5, i % 270 - 145);
    floats.values.push_back(static_cast<double>(static_cast<float>(value)));
    doubles.values.push_back(value / 3.0);
  }
  for (const double value : {-0.0, std::numeric_limits<double>::infinity(), 5e-324, 1e308}) {
    floats.values.push_back(std::signbit(value) ? -0.0 : std::numeric_limits<double>::infinity());
    doubles.values.push_back(value);
  }
  element.count = floats.values.size();
  element.properties = {floats, doubles};
  document.elements = {element};
  ASSERT_TRUE(WritePly(directory / "a.ply", document).ok());
  const StatusOr<PlyDocument> again = ReadPly(directory / "a.ply");
  ASSERT_TRUE(again.ok()) << again.status().message();
  ExpectSameDocument(document, *again);
  EXPECT_TRUE(std::signbit(again->elements[0].properties[1].values[2000]));
}

TEST(PlyReader, TakesNanAndInfInTheirSpellings) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.ply",
             AsciiMesh({"nan -nan NaN", "inf -Infinity +1e400", "+1.5 1E-400 .5"}, {}));
  const StatusOr<PlyDocument> document = ReadPly(directory / "a.ply");
  ASSERT_TRUE(document.ok()) << document.status().message();
  const PlyElement& vertices = document->elements[0];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const char* axis : {"x", "y", "z"}) EXPECT_TRUE(std::isnan(vertices.Find(axis)->values[0]));
  EXPECT_EQ(vertices.Find("x")->values[1], kInfinity);
  EXPECT_EQ(vertices.Find("y")->values[1], -kInfinity);
  EXPECT_EQ(vertices.Find("z")->values[1], kInfinity);
  EXPECT_EQ(vertices.Find("x")->values[2], 1.5);
  EXPECT_EQ(vertices.Find("y")->values[2], 0.0);
  EXPECT_EQ(vertices.Find("z")->values[2], 0.5);
}

TEST(PlyReader, TakesBlankLinesTabsAndAMissingLastLineEnd) {
  const TemporaryDirectory directory;
  WriteBytes(
      directory / "a.ply",
      "ply\nformat ascii 1.0\n\n  element vertex 2 \nproperty\tint x\nend_header\n\n 7.0\t\n\n8");
  const StatusOr<PlyDocument> document = ReadPly(directory / "a.ply");
  ASSERT_TRUE(document.ok()) << document.status().message();
  EXPECT_THAT(document->elements[0].properties[0].values, ElementsAre(7, 8));
}

TEST(PlyReader, TakesSignedListCountsAndMixedLineEnds) {
  const TemporaryDirectory directory;
  for (const char* count_type : {"char", "int8", "short", "int16", "int", "int32"}) {
    for (const bool mixed : {false, true}) {
      std::string header = "binary_little_endian 1.0\nelement face 2\nproperty list " +
                           std::string(count_type) + " int vertex_indices\nend_header\n";
      header = (mixed ? "ply\r\nformat " : "ply\nformat ") + header;
      BodyMaker body(Encoding::kLittle);
      const std::string type = count_type;
      const std::vector<std::vector<int>> lists = {{1, 2, 3}, {}};
      for (const std::vector<int>& list : lists) {
        const int size = static_cast<int>(list.size());
        if (type == "char" || type == "int8") body.Put<signed char>(static_cast<signed char>(size));
        if (type == "short" || type == "int16") body.Put<short>(static_cast<short>(size));
        if (type == "int" || type == "int32") body.Put<int>(size);
        for (const int value : list) body.Put<int>(value);
      }
      WriteBytes(directory / "a.ply", header + body.body());
      const StatusOr<PlyDocument> document = ReadPly(directory / "a.ply");
      ASSERT_TRUE(document.ok()) << count_type << ": " << document.status().message();
      const PlyProperty& property = document->elements[0].properties[0];
      EXPECT_THAT(property.list_sizes, ElementsAre(3, 0)) << count_type;
      EXPECT_THAT(property.values, ElementsAre(1, 2, 3)) << count_type;
      ASSERT_TRUE(WritePly(directory / "b.ply", *document).ok());
      const StatusOr<PlyDocument> again = ReadPly(directory / "b.ply");
      ASSERT_TRUE(again.ok());
      ExpectSameDocument(*document, *again);
    }
  }
}

// Returns `bytes` with each line end of its header replaced.
std::string WithLineEnds(const std::string& bytes, const std::string& line_end) {
  const std::string last_line = "end_header\n";
  const std::size_t size = bytes.find(last_line) + last_line.size();
  std::string header;
  for (const char c : bytes.substr(0, size)) header += c == '\n' ? line_end : std::string(1, c);
  return header + bytes.substr(size);
}

TEST_P(PlyRoundTrip, TakesCarriageReturnsAlone) {
  const std::string bytes = RichPly(encoding(), false);
  WriteBytes(directory_ / "lf.ply", bytes);
  const StatusOr<PlyDocument> expected = ReadPly(directory_ / "lf.ply");
  ASSERT_TRUE(expected.ok()) << expected.status().message();
  std::string with_cr = WithLineEnds(bytes, "\r");
  if (encoding() == Encoding::kAscii) std::replace(with_cr.begin(), with_cr.end(), '\n', '\r');
  // In a binary file the first line may end differently from the others.
  const std::string first_alone = "ply\r" + bytes.substr(4);
  for (const std::string& file : {with_cr, first_alone}) {
    WriteBytes(directory_ / "cr.ply", file);
    const StatusOr<PlyDocument> document = ReadPly(directory_ / "cr.ply");
    ASSERT_TRUE(document.ok()) << document.status().message();
    ExpectSameDocument(*expected, *document);
  }
}

TEST_P(PlyRoundTrip, TakesAByteOrderMarkAndBlanksBehindTheFirstWord) {
  const std::string bytes = RichPly(encoding(), crlf());
  WriteBytes(directory_ / "in.ply", bytes);
  const StatusOr<PlyDocument> expected = ReadPly(directory_ / "in.ply");
  ASSERT_TRUE(expected.ok()) << expected.status().message();
  for (const char* const start : {"\xef\xbb\xbfply", "ply ", "ply\t ", "\xef\xbb\xbfply "}) {
    WriteBytes(directory_ / "other.ply", std::string(start) + bytes.substr(3));
    const StatusOr<PlyDocument> document = ReadPly(directory_ / "other.ply");
    ASSERT_TRUE(document.ok()) << document.status().message();
    ExpectSameDocument(*expected, *document);
  }
}

// A body may begin with a byte that could be a part of a line end.
TEST(PlyReader, TakesNoByteOfABinaryBodyForALineEnd) {
  const TemporaryDirectory directory;
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar u\nend_header\n";
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    WriteBytes(directory / "a.ply", WithLineEnds(header, line_end) + "\n\r\n");
    const StatusOr<PlyDocument> document = ReadPly(directory / "a.ply");
    ASSERT_TRUE(document.ok()) << document.status().message();
    EXPECT_THAT(document->elements[0].properties[0].values, ElementsAre(10, 13, 10));
  }
}

// Rows are read in blocks.
TEST(PlyReader, ReadsManyRowsOfManyColumns) {
  const TemporaryDirectory directory;
  for (const Encoding encoding : {Encoding::kLittle, Encoding::kBig}) {
    BodyMaker body(encoding);
    for (int i = 0; i < 5000; ++i) body.Put<short>(static_cast<short>(-i)).Put<double>(0.1 * i);
    WriteBytes(directory / "a.ply",
               std::string("ply\nformat ") + FormatWord(encoding) +
                   " 1.0\nelement vertex 5000\nproperty short s\nproperty double d\nend_header\n" +
                   body.body());
    const StatusOr<PlyDocument> document = ReadPly(directory / "a.ply");
    ASSERT_TRUE(document.ok()) << document.status().message();
    for (std::size_t i = 0; i < 5000; ++i) {
      EXPECT_EQ(document->elements[0].properties[0].values[i], -static_cast<double>(i));
      EXPECT_EQ(document->elements[0].properties[1].values[i], 0.1 * static_cast<int>(i));
    }
  }
}

TEST(PlyReader, IgnoresBytesBehindTheLastRow) {
  const TemporaryDirectory directory;
  for (const Encoding encoding : {Encoding::kAscii, Encoding::kLittle}) {
    WriteBytes(directory / "a.ply", RichPly(encoding, false) + "trailing");
    EXPECT_TRUE(ReadPly(directory / "a.ply").ok()) << FormatWord(encoding);
  }
}

TEST(PlyReader, ReadsTheRealSurfacesWithoutLoss) {
  const char* const data = std::getenv("CERES_ED_DATA");
  if (data == nullptr) GTEST_SKIP() << "CERES_ED_DATA is not set";
  const TemporaryDirectory directory;
  int num_files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".ply") continue;
    const StatusOr<PlyDocument> document = ReadPly(entry.path().string());
    ASSERT_TRUE(document.ok()) << document.status().message();
    ASSERT_TRUE(WritePly(directory / "out.ply", *document).ok());
    EXPECT_EQ(ReadBytes(directory / "out.ply"), ReadBytes(entry.path().string())) << entry.path();
    ++num_files;
  }
  EXPECT_GT(num_files, 0);
}

}  // namespace
}  // namespace ceres_ed
