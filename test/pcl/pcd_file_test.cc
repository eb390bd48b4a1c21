#include "ceres_ed/io/mesh/pcd_file.h"

#include <ceres_ed/io/cloud_io.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <sys/resource.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

pcl::PointCloud<pcl::PointXYZRGB> SmallCloud() {
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  for (int i = 0; i < 6; ++i) {
    pcl::PointXYZRGB point;
    point.x = 0.1F * static_cast<float>(i);
    point.y = -1.0F;
    point.z = 1e-3F;
    point.r = static_cast<std::uint8_t>(250 + i);
    point.g = 4;
    point.b = 5;
    cloud.push_back(point);
  }
  cloud.width = 3;
  cloud.height = 2;
  cloud.sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  return cloud;
}

TEST(PcdFile, ReadsWhatPclWritesInEveryEncoding) {
  const TemporaryDirectory directory;
  const pcl::PointCloud<pcl::PointXYZRGB> cloud = SmallCloud();
  pcl::PCDWriter writer;
  const std::string path = directory / "in.PCD";
  for (int encoding = 0; encoding < 3; ++encoding) {
    if (encoding == 0) ASSERT_EQ(writer.writeASCII(path, cloud, 9), 0);
    if (encoding == 1) ASSERT_EQ(writer.writeBinary(path, cloud), 0);
    if (encoding == 2) ASSERT_EQ(writer.writeBinaryCompressed(path, cloud), 0);
    const StatusOr<LoadedCloud> loaded = LoadCloud(path);
    ASSERT_TRUE(loaded.ok()) << encoding << ": " << loaded.status().message();
    ASSERT_EQ(loaded->cloud.size(), 6u);
    EXPECT_EQ(loaded->cloud.points[4], Eigen::Vector3d(0.1F * 4.0F, -1.0, 1e-3F));
    const PlyElement& vertices = *loaded->document.Find("vertex");
    EXPECT_THAT(vertices.Find("red")->values, ElementsAre(250, 251, 252, 253, 254, 255));
    EXPECT_THAT(loaded->document.obj_info,
                ElementsAre("num_cols 3", "num_rows 2", "viewpoint 1 2 3 1 0 0 0"));
  }
}

TEST(PcdFile, WritesWhatPclReads) {
  const TemporaryDirectory directory;
  ASSERT_EQ(pcl::PCDWriter().writeBinary(directory / "in.pcd", SmallCloud()), 0);
  const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "in.pcd");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  std::vector<Eigen::Vector3d> points = loaded->cloud.points;
  points[5] = Eigen::Vector3d(7, 8, 9);
  const Status saved = SaveCloud(directory / "out.pcd", *loaded, points, nullptr);
  ASSERT_TRUE(saved.ok()) << saved.message();

  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  ASSERT_EQ(pcl::PCDReader().read(directory / "out.pcd", cloud), 0);
  ASSERT_EQ(cloud.size(), 6u);
  EXPECT_EQ(cloud.width, 3u);
  EXPECT_EQ(cloud.sensor_origin_.head<3>(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud[5].y, 8.0F);
  EXPECT_EQ(cloud[4].x, 0.1F * 4.0F);
  EXPECT_EQ(cloud[4].r, 254);
}

// Nothing of what a PLY's vertices may have is lost on the way.
TEST(PcdFile, KeepsEveryTypeAndListsOfOneLength) {
  const TemporaryDirectory directory;
  PlyDocument document;
  PlyElement vertices;
  vertices.name = "vertex";
  vertices.count = 2;
  vertices.properties = {MakePlyScalar("x", PlyType::kFloat64, {0.1, 1e100}),
                         MakePlyScalar("i8", PlyType::kInt8, {-128, 127}),
                         MakePlyScalar("u8", PlyType::kUint8, {0, 255}),
                         MakePlyScalar("i16", PlyType::kInt16, {-32768, 32767}),
                         MakePlyScalar("u16", PlyType::kUint16, {0, 65535}),
                         MakePlyScalar("i32", PlyType::kInt32, {-2147483648.0, 2147483647}),
                         MakePlyScalar("u32", PlyType::kUint32, {0, 4294967295.0}),
                         MakePlyScalar("f", PlyType::kFloat32, {-0.5, 0.25})};
  PlyProperty list = MakePlyList("histogram", PlyType::kUint8, PlyType::kFloat32);
  list.list_sizes = {3, 3};
  list.values = {1, 2, 3, 4, 5, 6};
  vertices.properties.push_back(list);
  document.elements = {vertices};
  const Status written = WritePcd(directory / "a.pcd", document);
  ASSERT_TRUE(written.ok()) << written.message();
  const StatusOr<PlyDocument> again = ReadPcd(directory / "a.pcd");
  ASSERT_TRUE(again.ok()) << again.status().message();
  for (const PlyProperty& property : vertices.properties) {
    const PlyProperty* const found = again->elements[0].Find(property.name);
    ASSERT_NE(found, nullptr) << property.name;
    EXPECT_EQ(found->type, property.type) << property.name;
    EXPECT_EQ(found->values, property.values) << property.name;
    EXPECT_EQ(found->list_sizes, property.list_sizes) << property.name;
  }
}

TEST(PcdFile, SkipsPaddingAndTakesTheOldNameOfFields) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.pcd",
             "COLUMNS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 2 1 1\nPOINTS 2\nDATA ascii\n"
             "1 0 0 2 3\n4 0 0 5 6\n");
  const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "a.pcd");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  ASSERT_EQ(loaded->cloud.size(), 2u);
  EXPECT_EQ(loaded->cloud.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(loaded->cloud.points[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(loaded->document.Find("vertex")->properties.size(), 3u);
}

TEST(PcdFile, SaysWhatItCannotHold) {
  const TemporaryDirectory directory;
  PointCloud cloud;
  cloud.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  cloud.triangles = {{0, 1, 2}};
  EXPECT_EQ(WriteCloud(directory / "a.pcd", cloud).message(),
            directory / "a.pcd" +
                ": a PCD file holds points alone, and there are 1 rows of element 'face', "
                "expected a name that ends in .ply");
  EXPECT_EQ(directory.NumFiles(), 0u);
}

std::string ErrorOf(const std::string& bytes) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "bad.pcd", bytes);
  const StatusOr<PlyDocument> document = ReadPcd(directory / "bad.pcd");
  if (document.ok()) return "no error";
  const std::string message = document.status().message();
  EXPECT_THAT(message, StartsWith(directory / "bad.pcd" + ": "));
  return message.substr((directory / "bad.pcd: ").size());
}

std::string Header(const std::string& points, const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

TEST(PcdFile, NamesWhatIsWrongWithAHeader) {
  EXPECT_EQ(ErrorOf("ply\n"), "not a PCD file: it has no line 'DATA'");
  EXPECT_EQ(ErrorOf(Header("-3", "binary")),
            "line 7: WIDTH has '-3', expected a whole number of at least 0");
  EXPECT_THAT(ErrorOf(Header("1", "gzip") + std::string(12, 'a')),
              HasSubstr("DATA is 'gzip', expected ascii, binary or binary_compressed"));
  EXPECT_THAT(ErrorOf("FIELDS x y\nSIZE 4\nPOINTS 1\nDATA ascii\n1 2\n"),
              StartsWith("the header needs FIELDS"));
  EXPECT_THAT(ErrorOf("FIELDS t\nSIZE 8\nTYPE U\nPOINTS 1\nDATA ascii\n1\n"),
              StartsWith("field 't' has a type that cannot be used"));
  EXPECT_EQ(ErrorOf(Header("2", "ascii") + "1 2 3\n4 5x 6\n"),
            "line 13: field 'y' is '5x', expected a number that fits its type");
  EXPECT_EQ(
      ErrorOf(Header("3", "binary") + std::string(35, 'a')),
      "truncated: the header promises 3 points of 12 bytes, and the file has too few behind its "
      "header");
}

// The promised points would take 48 GB.
TEST(PcdFile, PromisedCountsCostNoMemory) {
  struct rusage before;
  getrusage(RUSAGE_SELF, &before);
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    EXPECT_THAT(ErrorOf(Header("4000000000", data) + "1 2 3\n"), StartsWith("truncated: ")) << data;
  }
  struct rusage after;
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024) << "kilobytes";
}

TEST(PcdFile, SurvivesTruncationAndFlippedBytes) {
  const TemporaryDirectory directory;
  pcl::PCDWriter writer;
  unsigned int random = 7;
  const auto next = [&random] { return (random = random * 1664525u + 1013904223u) >> 8; };
  for (int encoding = 0; encoding < 3; ++encoding) {
    const std::string path = directory / "a.pcd";
    if (encoding == 0) ASSERT_EQ(writer.writeASCII(path, SmallCloud(), 9), 0);
    if (encoding == 1) ASSERT_EQ(writer.writeBinary(path, SmallCloud()), 0);
    if (encoding == 2) ASSERT_EQ(writer.writeBinaryCompressed(path, SmallCloud()), 0);
    const std::string bytes = ReadBytes(path);
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = bytes;
      if (trial % 3 == 0) damaged.resize(next() % damaged.size());
      for (unsigned int i = 0; i < next() % 3 && !damaged.empty(); ++i) {
        damaged[next() % damaged.size()] = static_cast<char>(next());
      }
      WriteBytes(directory / "damaged.pcd", damaged);
      const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "damaged.pcd");
      if (loaded.ok()) EXPECT_LE(loaded->cloud.size(), 1000u);
    }
  }
}

}  // namespace
}  // namespace ceres_ed
