#include "ceres_ed/io/cloud_io.h"

#include "io_test_util.h"

#include <ceres_ed/io/mesh/ply_reader.h>
#include <ceres_ed/io/mesh/ply_writer.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Triangle = std::array<int, 3>;

class CloudIo : public ::testing::Test {
 protected:
  StatusOr<LoadedCloud> Load(const std::string& bytes) {
    WriteBytes(path_, bytes);
    return LoadCloud(path_);
  }
  // Returns the error without "in.ply: ".
  std::string ErrorOf(const std::string& bytes) {
    const StatusOr<LoadedCloud> loaded = Load(bytes);
    return loaded.ok() ? "no error" : loaded.status().message().substr(path_.size() + 2);
  }
  std::string Warning(const std::string& what) const { return path_ + ": " + what; }

  TemporaryDirectory directory_;
  std::string path_ = directory_ / "in.ply";
};

std::string PointsPly(const std::string& properties, const std::vector<std::string>& rows) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(rows.size()) + "\n" +
                     properties + "end_header\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

TEST_F(CloudIo, ReadsBrightnessFromColorsOfAnyType) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const auto colors = [&](const std::string& type) {
    return xyz + "property " + type + " red\nproperty " + type + " green\nproperty " + type +
           " blue\n";
  };
  const StatusOr<LoadedCloud> bytes =
      Load(PointsPly(colors("uchar"), {"0 0 0 255 255 255", "nan 0 0 9 9 9", "1 0 0 51 102 204"}));
  ASSERT_TRUE(bytes.ok()) << bytes.status().message();
  ASSERT_TRUE(bytes->cloud.HasIntensities());
  EXPECT_NEAR(bytes->cloud.intensities[0], 1.0, 1e-15);
  EXPECT_NEAR(bytes->cloud.intensities[1], 0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.8, 1e-15);
  const StatusOr<LoadedCloud> floats =
      Load(PointsPly(colors("double"), {"0 0 0 0.2 0.4 0.8", "0 0 0 0 nan 0", "0 0 0 7 7 7"}));
  ASSERT_TRUE(floats.ok()) << floats.status().message();
  EXPECT_NEAR(floats->cloud.intensities[0], 0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.8, 1e-15);
  EXPECT_TRUE(std::isnan(floats->cloud.intensities[1]));
  EXPECT_EQ(floats->cloud.intensities[2], 1.0);
  const StatusOr<LoadedCloud> shorts = Load(PointsPly(colors("ushort"), {"0 0 0 65535 0 0"}));
  ASSERT_TRUE(shorts.ok()) << shorts.status().message();
  EXPECT_NEAR(shorts->cloud.intensities[0], 0.299, 1e-15);
}

TEST_F(CloudIo, TheWholeColumnTellsTheRangeOfColors) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  for (const std::string type : {"float", "double", "int", "uint", "ushort", "short"}) {
    const std::string columns = xyz + "property " + type + " red\nproperty " + type +
                                " green\nproperty " + type + " blue\n";
    const StatusOr<LoadedCloud> loaded =
        Load(PointsPly(columns, {"0 0 0 51 51 51", "1 0 0 1 1 1", "0 1 0 254 0 0"}));
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_NEAR(loaded->cloud.intensities[0], 0.2, 1e-12) << type;
    EXPECT_NEAR(loaded->cloud.intensities[1], 1.0 / 255.0, 1e-12) << type;
    EXPECT_THAT(loaded->warnings,
                ElementsAre(path_ + ": the largest colour is 254: colours are taken as 0 to 255"))
        << type;
  }
  const StatusOr<LoadedCloud> wide =
      Load(PointsPly(xyz + "property float red\nproperty float green\nproperty float blue\n",
                     {"0 0 0 13107 13107 13107", "1 0 0 60000 1 1"}));
  ASSERT_TRUE(wide.ok()) << wide.status().message();
  EXPECT_NEAR(wide->cloud.intensities[0], 0.2, 1e-12);
}

// The strip 0 1 2 3, then 4 5 6, then one that repeats a corner.
TEST_F(CloudIo, ReadsTriangleStrips) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 7\n";
  text += "property float x\nproperty float y\nproperty float z\n";
  const std::string strips = "element tristrips 2\nproperty list int int vertex_indices\n";
  std::string rows = "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n3 0 0\n";
  rows += "8 0 1 2 3 -1 4 5 6\n4 0 1 1 2\n";
  for (const std::string faces : {"", "element face 0\nproperty list uchar int vertex_indices\n"}) {
    const StatusOr<LoadedCloud> loaded = Load(text + faces + strips + rows);
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    using Triangle = std::array<int, 3>;
    EXPECT_THAT(loaded->cloud.triangles,
                ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{4, 5, 6}));
    EXPECT_THAT(loaded->warnings, ElementsAre());
  }
  const StatusOr<LoadedCloud> beyond =
      Load(text + strips +
           "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n3 0 0\n"
           "3 0 1 7\n3 0 1 2\n");
  EXPECT_EQ(beyond.status().message(), path_ + ": strip 0 names vertex 7, the file has 7");
}

TEST_F(CloudIo, HasNoBrightnessWithoutAllThreeColors) {
  const StatusOr<LoadedCloud> loaded =
      Load(PointsPly("property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                     "property uchar green\n",
                     {"0 0 0 1 2"}));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_TRUE(loaded->cloud.intensities.empty());
}

TEST_F(CloudIo, FansPolygonsOfAnySizeInEveryEncoding) {
  for (const Encoding encoding : {Encoding::kAscii, Encoding::kLittle, Encoding::kBig}) {
    for (const bool crlf : {false, true}) {
      const StatusOr<LoadedCloud> loaded = Load(RichPly(encoding, crlf));
      ASSERT_TRUE(loaded.ok()) << loaded.status().message();
      ASSERT_EQ(loaded->cloud.size(), 5u);
      for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(loaded->cloud.points[i], Eigen::Vector3d(i, 0.5 * i, -i));
      }
      EXPECT_THAT(loaded->cloud.triangles,
                  ElementsAre(Triangle{0, 1, 2},
                              Triangle{0, 2, 3},
                              Triangle{0, 1, 2},
                              Triangle{0, 2, 3},
                              Triangle{0, 3, 4},
                              Triangle{4, 3, 2}));
      EXPECT_THAT(loaded->vertex_of_point, ElementsAre(0, 1, 2, 3, 4));
      EXPECT_THAT(loaded->warnings, IsEmpty());
      EXPECT_FALSE(loaded->cloud.HasNormals());
    }
  }
}

TEST_F(CloudIo, CutsConcavePolygonsWithoutOverlap) {
  // An L whose first corner does not see all others, and the same with a corner that is not finite.
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string faces = "6 1 2 3 4 5 0\n";
  const StatusOr<LoadedCloud> loaded =
      Load(head + "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n" + faces);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  ASSERT_EQ(loaded->cloud.triangles.size(), 4u);
  const std::vector<Eigen::Vector3d>& p = loaded->cloud.points;
  for (const Triangle& t : loaded->cloud.triangles) {
    EXPECT_GT((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z(), 0.0);
  }
  const StatusOr<LoadedCloud> part =
      Load(head + "0 0 0\n2 0 0\n2 1 0\n1 1 0\nnan 2 0\n0 2 0\n" + faces);
  ASSERT_TRUE(part.ok()) << part.status().message();
  EXPECT_EQ(part->cloud.triangles.size(), 2u);
}

TEST_F(CloudIo, TakesCoordinatesOfAnyTypeInAnyOrderAndVertexIndex) {
  const StatusOr<LoadedCloud> loaded = Load(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list int uint vertex_index\n"
      "element vertex 3\nproperty short z\nproperty uchar y\nproperty double x\nend_header\n"
      "3 2 1 0\n-1 2 0.1\n-4 5 0.2\n7 8 0.3\n");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->cloud.points[0], Eigen::Vector3d(0.1, 2, -1));
  EXPECT_EQ(loaded->cloud.points[2], Eigen::Vector3d(0.3, 8, 7));
  EXPECT_THAT(loaded->cloud.triangles, ElementsAre(Triangle{2, 1, 0}));
}

TEST_F(CloudIo, NormalisesNormalsOfEitherNameAndKeepsBadOnesAsZero) {
  for (const std::string prefix : {"n", "normal_"}) {
    const StatusOr<LoadedCloud> loaded = Load(PointsPly(
        "property float x\nproperty float y\nproperty float z\nproperty double " + prefix +
            "x\nproperty double " + prefix + "y\nproperty double " + prefix + "z\n",
        {"0 0 0 3 0 4", "1 0 0 0 0 0", "2 0 0 nan 0 1", "3 0 0 0 1e-200 0"}));
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    ASSERT_TRUE(loaded->cloud.HasNormals());
    EXPECT_LT((loaded->cloud.normals[0] - Eigen::Vector3d(0.6, 0, 0.8)).norm(), 1e-15);
    EXPECT_EQ(loaded->cloud.normals[1], Eigen::Vector3d::Zero());
    EXPECT_EQ(loaded->cloud.normals[2], Eigen::Vector3d::Zero());
    EXPECT_LT((loaded->cloud.normals[3] - Eigen::Vector3d::UnitY()).norm(), 1e-15);
    EXPECT_THAT(loaded->warnings, ElementsAre(Warning("2 normals of zero length or not finite")));
  }
}

TEST_F(CloudIo, LeavesNormalsOutWhereAllAreZero) {
  const StatusOr<LoadedCloud> loaded =
      Load(PointsPly("property float x\nproperty float y\nproperty float z\nproperty float nx\n"
                     "property float ny\nproperty float nz\n",
                     {"0 0 0 0 0 0", "1 0 0 0 0 0"}));
  ASSERT_TRUE(loaded.ok());
  EXPECT_FALSE(loaded->cloud.HasNormals());
  EXPECT_EQ(loaded->warnings.size(), 1u);
}

TEST_F(CloudIo, DropsBadPointsAndTheirTrianglesWithCountedWarnings) {
  const StatusOr<LoadedCloud> loaded =
      Load(AsciiMesh({"nan 0 0", "1 0 0", "0 1 0", "0 -inf 0", "0 0 1", "0 0 2e18"},
                     {"3 1 2 4", "3 0 1 2", "4 1 2 4 5"}));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_THAT(loaded->vertex_of_point, ElementsAre(1, 2, 4));
  EXPECT_EQ(loaded->cloud.points[2], Eigen::Vector3d(0, 0, 1));
  EXPECT_THAT(loaded->cloud.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}));
  EXPECT_THAT(loaded->warnings,
              ElementsAre(Warning("3 points with coordinates that are not finite dropped"),
                          Warning("2 triangles on dropped points dropped")));
}

// A sensor that writes a vertex for each pixel has depth at a few of them.
TEST_F(CloudIo, ReadsACloudOfWhichATenthIsMeasured) {
  std::vector<std::string> rows(100, "nan nan nan");
  for (int i = 0; i < 10; ++i) rows[10 * i + 3] = std::to_string(i) + " 0 1";
  const StatusOr<LoadedCloud> loaded = Load(AsciiMesh(rows, {}));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->cloud.size(), 10u);
  EXPECT_EQ(loaded->vertex_of_point[1], 13);
  EXPECT_THAT(
      loaded->warnings,
      ElementsAre(Warning("90 points (of 100) with coordinates that are not finite dropped")));
}

TEST_F(CloudIo, RefusesACloudWithoutAFinitePoint) {
  EXPECT_EQ(ErrorOf(AsciiMesh({"nan 0 0", "0 inf 0"}, {})),
            "none of the 2 vertices has finite coordinates");
}

TEST_F(CloudIo, SkipsSmallPolygonsAndRepeatedCornersWithCountedWarnings) {
  const StatusOr<LoadedCloud> loaded =
      Load(AsciiMesh({"0 0 0", "1 0 0", "0 1 0", "0 0 1"},
                     {"2 0 1", "0", "1 3", "3 0 1 1", "4 0 1 1 2", "3 0 1 2"}));
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_THAT(loaded->cloud.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}));
  EXPECT_THAT(loaded->warnings,
              ElementsAre(Warning("3 faces of fewer than three corners dropped"),
                          Warning("2 triangles with a repeated corner dropped")));
}

TEST_F(CloudIo, RefusesAFaceIndexOutOfRange) {
  const std::vector<std::string> rows = {"0 0 0", "1 0 0", "0 1 0"};
  EXPECT_EQ(ErrorOf(AsciiMesh(rows, {"3 0 1 2", "3 0 1 99999"})),
            "face 1 names vertex 99999, the file has 3");
  EXPECT_EQ(ErrorOf(AsciiMesh(rows, {"3 0 -1 2"})), "face 0 names vertex -1, the file has 3");
  EXPECT_EQ(ErrorOf(AsciiMesh(rows, {"1 3"})), "face 0 names vertex 3, the file has 3");
}

TEST_F(CloudIo, NamesWhatACloudLacks) {
  EXPECT_EQ(ErrorOf("ply\nformat ascii 1.0\nend_header\n"), "no element 'vertex'");
  EXPECT_EQ(ErrorOf(AsciiMesh({}, {})), "no vertices, expected at least one");
  EXPECT_EQ(ErrorOf(PointsPly("property float x\nproperty float depth\n", {"0 0"})),
            "element 'vertex' has the properties 'x depth', expected x y z");
  EXPECT_EQ(ErrorOf(PointsPly("property float x\nproperty float y\nproperty list uchar int z\n",
                              {"0 0 1 1"})),
            "element 'vertex' has the properties 'x y z', expected x y z");
  EXPECT_THAT(
      ErrorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty int a\nend_header\n0 0 0\n1\n"),
      HasSubstr("no list 'vertex_indices'"));
  EXPECT_THAT(ErrorOf("GIF89a"), HasSubstr("not a PLY file"));
  EXPECT_THAT(LoadCloud(directory_ / "none.ply").status().message(),
              HasSubstr("No such file or directory"));
}

TEST_F(CloudIo, SaveReplacesPositionsAndKeepsTheRest) {
  for (const Encoding encoding : {Encoding::kAscii, Encoding::kLittle, Encoding::kBig}) {
    const StatusOr<LoadedCloud> loaded = Load(RichPly(encoding, true));
    ASSERT_TRUE(loaded.ok());
    std::vector<Eigen::Vector3d> moved = loaded->cloud.points;
    for (Eigen::Vector3d& point : moved) point += Eigen::Vector3d(1, 2, 4);
    const std::string out = directory_ / "out.ply";
    ASSERT_TRUE(SaveCloud(out, loaded->document, loaded->vertex_of_point, moved, nullptr).ok());

    StatusOr<PlyDocument> again = ReadPly(out);
    ASSERT_TRUE(again.ok()) << again.status().message();
    EXPECT_THAT(again->Find("vertex")->Find("x")->values, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_THAT(again->Find("vertex")->Find("y")->values, ElementsAre(2, 2.5, 3, 3.5, 4));
    EXPECT_THAT(again->Find("vertex")->Find("z")->values, ElementsAre(4, 3, 2, 1, 0));
    EXPECT_EQ(again->Find("vertex")->Find("x")->type, PlyType::kFloat32);
    // With the old positions it is the old file again.
    for (const char* axis : {"x", "y", "z"}) {
      again->Find("vertex")->Find(axis)->values =
          loaded->document.Find("vertex")->Find(axis)->values;
    }
    ASSERT_TRUE(WritePly(directory_ / "a.ply", *again).ok());
    ASSERT_TRUE(WritePly(directory_ / "b.ply", loaded->document).ok());
    EXPECT_EQ(ReadBytes(directory_ / "a.ply"), ReadBytes(directory_ / "b.ply"));
  }
}

TEST_F(CloudIo, SaveLeavesDroppedRowsAndReplacesNormals) {
  const StatusOr<LoadedCloud> loaded =
      Load(PointsPly("property float x\nproperty float y\nproperty float z\nproperty float nx\n"
                     "property float ny\nproperty float nz\nproperty uchar red\n",
                     {"0 0 0 0 0 1 7", "nan 5 5 1 0 0 8", "1 1 1 0 0 1 9"}));
  ASSERT_TRUE(loaded.ok());
  const std::vector<Eigen::Vector3d> points = {{10, 11, 12}, {20, 21, 22}};
  const std::vector<Eigen::Vector3d> normals = {{1, 0, 0}, {0, 1, 0}};
  const std::string out = directory_ / "out.ply";
  ASSERT_TRUE(SaveCloud(out, loaded->document, loaded->vertex_of_point, points, &normals).ok());
  EXPECT_THAT(ReadBytes(out),
              HasSubstr("end_header\n10 11 12 1 0 0 7\nnan 5 5 1 0 0 8\n20 21 22 0 1 0 9\n"));
  // If no normals are given, the old ones are kept.
  ASSERT_TRUE(SaveCloud(out, loaded->document, loaded->vertex_of_point, points, nullptr).ok());
  EXPECT_THAT(ReadBytes(out), HasSubstr("\n10 11 12 0 0 1 7\n"));
}

TEST_F(CloudIo, SaveDoesNotRoundPositionsOfAnIntegerFile) {
  const StatusOr<LoadedCloud> loaded =
      Load(PointsPly("property int x\nproperty int y\nproperty int z\n", {"1 2 3"}));
  ASSERT_TRUE(loaded.ok());
  const std::string out = directory_ / "out.ply";
  ASSERT_TRUE(SaveCloud(out, loaded->document, {0}, {{1.25, 2.5, -3.1}}, nullptr).ok());
  const StatusOr<LoadedCloud> again = LoadCloud(out);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->cloud.points[0], Eigen::Vector3d(1.25, 2.5, -3.1));
}

TEST_F(CloudIo, SaveTakesDoublesWhereFloatsCannotHoldThePositions) {
  const StatusOr<LoadedCloud> loaded =
      Load(PointsPly("property float x\nproperty float y\nproperty float z\n"
                     "property float nx\nproperty float ny\nproperty float nz\n",
                     {"1 2 3 0 0 1", "4 5 6 0 0 1"}));
  ASSERT_TRUE(loaded.ok());
  const std::string out = directory_ / "out.ply";
  // UTM coordinates of a slope: floats there are half a metre apart.
  const std::vector<Eigen::Vector3d> far = {{465432.26, 5249876.51, 1843.1},
                                            {465440.13, 5249881.27, 1845.9}};
  ASSERT_TRUE(SaveCloud(out, *loaded, far, nullptr).ok());
  const StatusOr<LoadedCloud> again = LoadCloud(out);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->cloud.points, far);
  EXPECT_EQ(again->document.Find("vertex")->Find("nx")->type, PlyType::kFloat32);
  // Near the origin the type of the file is kept.
  ASSERT_TRUE(SaveCloud(out, *loaded, {{1.1, 2.1, 3.1}, {4.1, 5.1, 6.1}}, nullptr).ok());
  const StatusOr<LoadedCloud> near = LoadCloud(out);
  ASSERT_TRUE(near.ok());
  EXPECT_EQ(near->document.Find("vertex")->Find("y")->type, PlyType::kFloat32);
}

TEST_F(CloudIo, WriteCloudTakesDoublesWhereFloatsCannotHoldThePositions) {
  PointCloud cloud;
  cloud.points = {{465432.26, 5249876.51, 1843.1}, {465440.13, 5249881.27, 1845.9}};
  ASSERT_TRUE(WriteCloud(path_, cloud).ok());
  const StatusOr<LoadedCloud> again = LoadCloud(path_);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->cloud.points, cloud.points);
}

TEST_F(CloudIo, WriteCloudReadsBackWithColumnsAndColors) {
  PointCloud cloud;
  cloud.points = {{0.1, 0.2, 0.3}, {1, 0, 0}, {0, 1, 1.0 / 3.0}};
  cloud.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  cloud.triangles = {{0, 1, 2}, {2, 1, 0}};
  CloudWriteOptions options;
  options.double_precision = true;
  options.comments = {"made by a test"};
  options.colors = {{255, 0, 1}, {2, 3, 4}, {5, 6, 7}};
  options.columns = {MakePlyScalar("error", PlyType::kFloat64, {0.5, 1.0 / 7.0, 2.0}),
                     MakePlyScalar("id", PlyType::kInt32, {7, 8, 9})};
  for (const PlyFormat format :
       {PlyFormat::kAscii, PlyFormat::kBinaryLittleEndian, PlyFormat::kBinaryBigEndian}) {
    options.format = format;
    ASSERT_TRUE(WriteCloud(path_, cloud, options).ok());
    const StatusOr<LoadedCloud> loaded = LoadCloud(path_);
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_EQ(loaded->cloud.points, cloud.points);
    EXPECT_EQ(loaded->cloud.normals, cloud.normals);
    EXPECT_EQ(loaded->cloud.triangles, cloud.triangles);
    EXPECT_THAT(loaded->document.comments, ElementsAre("made by a test"));
    const PlyElement& vertices = *loaded->document.Find("vertex");
    EXPECT_EQ(vertices.Find("error")->values, options.columns[0].values);
    EXPECT_EQ(vertices.Find("id")->values, options.columns[1].values);
    EXPECT_EQ(vertices.Find("id")->type, PlyType::kInt32);
    EXPECT_THAT(vertices.Find("red")->values, ElementsAre(255, 2, 5));
    EXPECT_THAT(vertices.Find("blue")->values, ElementsAre(1, 4, 7));
  }
}

TEST_F(CloudIo, WriteCloudTakesFloatsAndBarePointsByDefault) {
  PointCloud cloud;
  cloud.points = {{0.1, 0.2, 0.3}};
  ASSERT_TRUE(WriteCloud(path_, cloud).ok());
  const StatusOr<LoadedCloud> loaded = LoadCloud(path_);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->cloud.points[0], Eigen::Vector3d(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(loaded->document.elements.size(), 1u);
}

TEST_F(CloudIo, WritingIntoAMissingDirectoryIsAnError) {
  PointCloud cloud;
  cloud.points = {{0, 0, 0}};
  EXPECT_THAT(WriteCloud(directory_ / "no/out.ply", cloud).message(),
              HasSubstr("out.ply: cannot write: No such file or directory"));
}

}  // namespace
}  // namespace ceres_ed
