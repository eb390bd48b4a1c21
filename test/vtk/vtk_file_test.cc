#include "ceres_ed/io/mesh/vtk_file.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/mesh_space.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>
#include <test/io/mesh_documents.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PlyDocument ReadOk(const std::string& path) {
  const StatusOr<PlyDocument> document = ReadMesh(path);
  EXPECT_TRUE(document.ok()) << document.status().message();
  return document.ok() ? *document : PlyDocument();
}

PlyDocument RichMesh(PlyType type) {
  PlyDocument document = OddMesh(type);
  AddNormals(type, &document);
  AddColors(&document);
  AddColumn("vertex", "label", PlyType::kInt32, {-7, 2, 3, 4, 5, 6, 2147483647}, &document);
  AddColumn("vertex", "id", PlyType::kUint32, {0, 2, 3, 4, 5, 6, 4294967295}, &document);
  AddColumn("vertex", "q", PlyType::kFloat64, {0.1, 1e-300, 3, 4, 5, 6, 1e300}, &document);
  AddColumn("vertex", "s", PlyType::kInt16, {-32768, 1, 2, 3, 4, 5, 32767}, &document);
  AddColumn("face", "part", PlyType::kUint16, {1, 65535, 3}, &document);
  AddColumn("face", "weight", PlyType::kFloat32, {0.5, 0.25, 3}, &document);
  return document;
}

TEST(VtkFile, BothFormatsKeepAllBitsTypesFacesAndData) {
  const TemporaryDirectory directory;
  for (const PlyType type : {PlyType::kFloat32, PlyType::kFloat64}) {
    const PlyDocument document = RichMesh(type);
    for (const std::string name : {"a.vtk", "a.vtp"}) {
      const Status status = WriteMesh(directory / name, document);
      ASSERT_TRUE(status.ok()) << status.message();
      EXPECT_THAT(LossesOf(directory / name, document), IsEmpty());
      const PlyDocument again = ReadOk(directory / name);
      EXPECT_THAT(again.warnings, IsEmpty());
      ExpectSameColumns(
          document,
          again,
          "vertex",
          {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "label", "id", "q", "s"},
          true);
      ExpectSameColumns(document, again, "face", {"part", "weight"}, true);
      ExpectSameColumns(document, again, "face", {"vertex_indices"});
      // And once more: names and roles of arrays are kept as well, so nothing changes.
      ASSERT_TRUE(WriteMesh(directory / ("b" + name), again).ok());
      EXPECT_EQ(ReadBytes(directory / name), ReadBytes(directory / ("b" + name))) << name;
    }
  }
}

TEST(VtkFile, TheSpaceThatSlicerNamesSurvives) {
  const TemporaryDirectory directory;
  PlyDocument document = OddMesh(PlyType::kFloat32);
  document.comments = {"SPACE=RAS"};
  for (const std::string name : {"a.vtk", "a.vtp"}) {
    ASSERT_TRUE(WriteMesh(directory / name, document).ok());
    EXPECT_EQ(SpaceOfDocument(ReadOk(directory / name)), AnatomicalSpace::kRas) << name;
  }
}

TEST(VtkFile, PointsWithoutFacesSurvive) {
  const TemporaryDirectory directory;
  PlyDocument document = OddMesh(PlyType::kFloat64);
  document.elements.pop_back();
  for (const std::string name : {"a.vtk", "a.vtp"}) {
    ASSERT_TRUE(WriteMesh(directory / name, document).ok());
    const PlyDocument again = ReadOk(directory / name);
    ExpectSameColumns(document, again, "vertex", {"x", "y", "z"}, true);
    EXPECT_EQ(again.Find("face"), nullptr);
  }
}

// As other programs write it: ascii, with a strip, a line, a name with a blank, and vectors.
constexpr char kAscii[] =
    "# vtk DataFile Version 3.0\nliver\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
    "0 0 0 1 0 0 0 1 0\n1 1 0 0 2 0\n"
    "LINES 1 4\n3 0 1 4\nPOLYGONS 1 5\n4 0 1 3 2\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
    "CELL_DATA 3\nSCALARS region int 1\nLOOKUP_TABLE default\n9 4 5\n"
    "POINT_DATA 5\nVECTORS my%20shift float\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n";

TEST(VtkFile, AFileOfAnotherProgramKeepsItsNamesAndItsCells) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.vtk", kAscii);
  const PlyDocument document = ReadOk(directory / "a.vtk");
  EXPECT_THAT(document.Find("face")->Find("vertex_indices")->values,
              ElementsAre(0, 1, 3, 2, 0, 1, 2, 1, 3, 2));
  EXPECT_THAT(document.Find("face")->Find("region")->values, ElementsAre(4, 5, 5));
  EXPECT_THAT(document.Find("vertex")->Find("my_shift_1")->values, ElementsAre(2, 5, 8, 11, 14));
  EXPECT_THAT(document.Find("edge")->Find("vertex2")->values, ElementsAre(1, 4));
  for (const std::string name : {"b.vtk", "b.vtp"}) {
    ASSERT_TRUE(WriteMesh(directory / name, document).ok());
    const std::string bytes = ReadBytes(directory / name);
    EXPECT_THAT(bytes, HasSubstr(name == "b.vtk" ? "my%20shift" : "my shift"));
    const PlyDocument again = ReadOk(directory / name);
    ExpectSameColumns(document, again, "vertex", {"x", "my_shift_0", "my_shift_2"}, true);
    ExpectSameColumns(document, again, "face", {"vertex_indices", "region"}, true);
    ExpectSameColumns(document, again, "edge", {"vertex1", "vertex2"}, true);
  }
}

TEST(VtkFile, OtherDataAndDamageAreOneSentenceWithoutOutputOfVtk) {
  const TemporaryDirectory directory;
  const auto error_of = [&](const std::string& name, const std::string& bytes) {
    WriteBytes(directory / name, bytes);
    testing::internal::CaptureStderr();
    const StatusOr<LoadedCloud> loaded = LoadCloud(directory / name);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return loaded.status().message();
  };
  const std::string grid =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\n"
      "CELLS 1 2\n1 0\nCELL_TYPES 1\n1\n";
  EXPECT_THAT(error_of("a.vtk", grid), HasSubstr("VTK cannot read it as a surface (poly data)"));
  std::string beyond = kAscii;
  beyond.replace(beyond.find("4 0 1 3 2"), 9, "4 0 1 3 7");
  EXPECT_THAT(error_of("a.vtk", beyond), HasSubstr("a cell names point 7, the file has 5"));
  // VTK would take 24 GB ahead of the first number.
  std::string many = kAscii;
  many.replace(many.find("POINTS 5"), 8, "POINTS 2000000000");
  EXPECT_THAT(error_of("a.vtk", many), HasSubstr("a.vtk: VTK cannot read it"));
  EXPECT_THAT(error_of("a.vtp", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n<PolyData>"),
              HasSubstr("a.vtp: VTK cannot read it"));
}

TEST(VtkFile, CutFilesGiveAnErrorThatNamesThemOrADocument) {
  const TemporaryDirectory directory;
  const PlyDocument document = RichMesh(PlyType::kFloat32);
  for (const std::string name : {"a.vtk", "a.vtp"}) {
    ASSERT_TRUE(WriteMesh(directory / name, document).ok());
    const std::string bytes = ReadBytes(directory / name);
    for (std::size_t size = 0; size < bytes.size(); size += 13) {
      WriteBytes(directory / ("cut" + name), bytes.substr(0, size));
      const StatusOr<LoadedCloud> loaded = LoadCloud(directory / ("cut" + name));
      if (!loaded.ok()) EXPECT_THAT(loaded.status().message(), HasSubstr("cut" + name));
    }
  }
}

}  // namespace
}  // namespace ceres_ed
