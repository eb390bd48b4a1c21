// STL, OBJ and OFF, which need no library.
#include "io_test_util.h"
#include "mesh_documents.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/mesh_space.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MeshFiles : public ::testing::Test {
 protected:
  PlyDocument Read(const std::string& name, const std::string& bytes) {
    WriteBytes(directory_ / name, bytes);
    return Read(name);
  }
  PlyDocument Read(const std::string& name) {
    const StatusOr<PlyDocument> document = ReadMesh(directory_ / name);
    EXPECT_TRUE(document.ok()) << document.status().message();
    return document.ok() ? *document : PlyDocument();
  }
  PlyDocument WrittenAndRead(const PlyDocument& document, const std::string& name) {
    const Status status = WriteMesh(directory_ / name, document);
    EXPECT_TRUE(status.ok()) << status.message();
    return Read(name);
  }
  // The message without the path.
  std::string ErrorOf(const std::string& name, const std::string& bytes) {
    WriteBytes(directory_ / name, bytes);
    const std::string message = LoadCloud(directory_ / name).status().message();
    const std::string path = directory_ / name + ": ";
    EXPECT_EQ(message.substr(0, path.size()), path);
    return message.substr(std::min(path.size(), message.size()));
  }

  TemporaryDirectory directory_;
};

// Little-endian: `triangles` of nine coordinates, with `bits` as their 16 bits.
std::string BinaryStl(const std::vector<std::vector<float>>& triangles,
                      std::uint16_t bits = 0,
                      const std::string& header = "") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(triangles.size());
  append(&count, 4);
  const float normal[3] = {0, 0, 1};
  for (const std::vector<float>& triangle : triangles) {
    append(normal, 12);
    append(triangle.data(), 36);
    append(&bits, 2);
  }
  return bytes;
}

TEST_F(MeshFiles, ObjAndOffKeepDoublesFacesColoursAndNormalsInTheirOrder) {
  PlyDocument document = OddMesh(PlyType::kFloat64);
  AddNormals(PlyType::kFloat64, &document);
  AddColors(&document);
  for (const std::string name : {"a.obj", "a.off"}) {
    const PlyDocument again = WrittenAndRead(document, name);
    ExpectSameColumns(document, again, "vertex", {"x", "y", "z", "nx", "ny", "nz"}, true);
    ExpectSameColumns(document, again, "vertex", {"red", "green", "blue"}, true);
    ExpectSameColumns(document, again, "face", {"vertex_indices"});
    EXPECT_THAT(again.warnings, IsEmpty()) << name;
    EXPECT_THAT(LossesOf(directory_ / name, document), IsEmpty()) << name;
  }
}

TEST_F(MeshFiles, ObjAndOffGiveTheSameBytesWhenTheyAreReadAndWritten) {
  PlyDocument document = OddMesh(PlyType::kFloat64);
  AddColors(&document);
  for (const std::string ending : {".obj", ".off"}) {
    ASSERT_TRUE(WriteMesh(directory_ / ("a" + ending), document).ok());
    const PlyDocument again = WrittenAndRead(Read("a" + ending), "b" + ending);
    EXPECT_EQ(ReadBytes(directory_ / ("a" + ending)), ReadBytes(directory_ / ("b" + ending)));
  }
}

TEST_F(MeshFiles, ObjKeepsTexturesGroupsMaterialsAndSegments) {
  const std::string text =
      "mtllib skin.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0.25\nvt 1 0.5\nvt 1 1\n"
      "o left ventricle\ng wall\nusemtl skin\nf 1/1 2/2 3/3\nusemtl scar\nf 1 3 4\nl 1 3\n";
  const PlyDocument document = Read("a.obj", text);
  EXPECT_THAT(document.warnings, IsEmpty());
  ASSERT_TRUE(WriteMesh(directory_ / "b.obj", document).ok());
  EXPECT_EQ(ReadBytes(directory_ / "b.obj"), text);
  // By way of a PLY, too.
  const PlyDocument ply = WrittenAndRead(document, "b.ply");
  ASSERT_TRUE(WriteMesh(directory_ / "c.obj", ply).ok());
  EXPECT_EQ(ReadBytes(directory_ / "c.obj"), text);
}

TEST_F(MeshFiles, ObjTakesWhatOtherProgramsWrite) {
  const PlyDocument document =
      Read("a.obj",
           "# 3ds\r\n\r\nv 0 0 0 1.0\r\nv 1 0 0 1.0\r\nv 0 1 0 1.0\r\nvn 0 0 1\r\nvn 0 0 2\r\n"
           "f -3//1 -2//1 \\\r\n-1//2\r\ncurv 0 1\r\n");
  ExpectSameColumns(document, document, "vertex", {"nx", "ny", "nz"});
  EXPECT_THAT(document.Find("vertex")->Find("nz")->values, ElementsAre(1, 1, 2));
  EXPECT_THAT(document.Find("face")->Find("vertex_indices")->values, ElementsAre(0, 1, 2));
  EXPECT_THAT(document.warnings,
              ElementsAre("the weights w of 3 vertices are left out",
                          "1 line with the keyword 'curv' left out"));
  const PlyDocument bytes = Read("b.obj", "v 0 0 0 255 0 7\nv 1 0 0 0 1 2\n");
  EXPECT_THAT(bytes.Find("vertex")->Find("red")->values, ElementsAre(255, 0));
  EXPECT_THAT(bytes.Find("vertex")->Find("blue")->values, ElementsAre(7, 2));
}

TEST_F(MeshFiles, ObjSaysWhatIsWrongAndWhere) {
  EXPECT_EQ(ErrorOf("a.obj", "v 0 0\n"),
            "line 1: a vertex of 2 numbers, expected x y z, which w or r g b may follow");
  EXPECT_EQ(ErrorOf("a.obj", "v 0 0 0\nv 0 one 0\n"), "line 2: 'one' is no number");
  EXPECT_EQ(ErrorOf("a.obj", "v 0 0 0\nf 1 1 2\nv 1 0 0\nf 1 2 7\n"),
            "line 4: a face names vertex 7, the file has 2");
  EXPECT_THAT(ErrorOf("a.obj", "v 0 0 0\nf 1 -2 1\n"), HasSubstr("line 2: a corner is '-2'"));
  EXPECT_THAT(ErrorOf("a.obj", "v 0 0 0\nf 0 1 1\n"), HasSubstr("line 2: a corner is '0'"));
}

TEST_F(MeshFiles, OffTakesItsVariants) {
  const std::string body = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string start : {"OFF\n", "OFF ", "", "# comment\nOFF\n\n", "OFF # x\n"}) {
    const PlyDocument document = Read("a.off", start + body);
    EXPECT_THAT(document.Find("vertex")->Find("x")->values, ElementsAre(0, 1, 0)) << start;
    EXPECT_THAT(document.Find("face")->Find("vertex_indices")->values, ElementsAre(0, 1, 2));
  }
  const PlyDocument colors =
      Read("b.off", "COFF\n2 1 0\n0 0 0 1 0 0 1\n1 0 0 0 0 0.2 1\n3 0 1 1 10 20 30\n");
  EXPECT_THAT(colors.Find("vertex")->Find("red")->values, ElementsAre(255, 0));
  EXPECT_THAT(colors.Find("vertex")->Find("blue")->values, ElementsAre(0, 51));
  EXPECT_THAT(colors.Find("face")->Find("green")->values, ElementsAre(20));
}

// A share above 1 would be read as a byte.
TEST_F(MeshFiles, OffKeepsColoursThatAreNoneWithinItsRange) {
  const PlyDocument document = Read("a.off",
                                    "COFF\n2 1 0\n0 0 0 1e999 510 102\n1 0 0 nan -3 255\n"
                                    "3 0 1 1 1e20 20.5 30\n");
  const PlyDocument again = WrittenAndRead(document, "b.off");
  EXPECT_THAT(again.Find("vertex")->Find("red")->values, ElementsAre(255, 0));
  EXPECT_THAT(again.Find("vertex")->Find("green")->values, ElementsAre(255, 0));
  EXPECT_THAT(again.Find("vertex")->Find("blue")->values, ElementsAre(102, 255));
  EXPECT_THAT(again.Find("face")->Find("red")->values, ElementsAre(1));
  WrittenAndRead(again, "c.off");
  EXPECT_EQ(ReadBytes(directory_ / "b.off"), ReadBytes(directory_ / "c.off"));
}

TEST_F(MeshFiles, ACommentStaysInItsLine) {
  PlyDocument document = OddMesh(PlyType::kFloat64);
  document.comments = {"one\rend_header\nv 1 2 3\r"};
  document.obj_info = {"two\nelement vertex 1\r"};
  for (const std::string name : {"a.ply", "a.off", "a.obj"}) {
    const PlyDocument again = WrittenAndRead(document, name);
    EXPECT_EQ(again.Find("vertex")->count, document.Find("vertex")->count) << name;
  }
  const PlyDocument again = Read("a.ply");
  EXPECT_THAT(again.comments, ElementsAre("one end_header v 1 2 3 "));
  EXPECT_THAT(again.obj_info, ElementsAre("two element vertex 1 "));
}

TEST_F(MeshFiles, OffSaysWhatIsWrongAndWhere) {
  EXPECT_EQ(ErrorOf("a.off", "4OFF\n1 0 0\n0 0 0 0\n"),
            "line 1: the keyword is '4OFF', expected OFF, with C, N or ST ahead of it (in three "
            "dimensions, ascii)");
  EXPECT_EQ(ErrorOf("a.off", "OFF\n2 1 0\n0 0 0\n"), "truncated: 1 of 2 vertices and 0 of 1 face");
  EXPECT_EQ(ErrorOf("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"),
            "line 4: a face names vertex 1, the file has 1");
  EXPECT_EQ(ErrorOf("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"), "line 4: a face of 3 corners names 2");
}

TEST_F(MeshFiles, StlConnectsItsTrianglesAndKeepsTheirOrderAndTheirBits) {
  const std::string bytes = BinaryStl({{0, 0, 0.1f, 1, 0, 0, 0, 1, 0},
                                       {1, 0, 0, 1, 1, 0, 0, 1, 0},
                                       {0, 0, 0.1f, 0, 1, 0, 0, 0, 0.1f}},
                                      0x801F,
                                      "solid is what this header begins with");
  const PlyDocument document = Read("a.stl", bytes);
  EXPECT_EQ(document.Find("vertex")->count, 4U);
  EXPECT_THAT(document.Find("face")->Find("vertex_indices")->values,
              ElementsAre(0, 1, 2, 1, 3, 2, 0, 2, 0));
  EXPECT_THAT(document.Find("face")->Find("attribute")->values,
              ElementsAre(0x801F, 0x801F, 0x801F));
  ASSERT_TRUE(WriteMesh(directory_ / "b.stl", document).ok());
  const std::string again = ReadBytes(directory_ / "b.stl");
  ASSERT_EQ(again.size(), bytes.size());
  for (std::size_t triangle = 0; triangle < 3; ++triangle) {
    const std::size_t begin = 84 + 50 * triangle + 12;
    EXPECT_EQ(again.substr(begin, 38), bytes.substr(begin, 38)) << "triangle " << triangle;
  }
}

TEST_F(MeshFiles, AnAsciiStlIsWrittenAsOneWithItsNames) {
  const std::string text =
      "solid left half\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.1 0 0\n"
      "vertex 0 1e-30 0\nendloop\nendfacet\nendsolid left half\nsolid right\n"
      "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\n"
      "endfacet\nendsolid right\n";
  const PlyDocument document = Read("a.stl", text);
  EXPECT_THAT(LossesOf("b.stl", document), IsEmpty());
  ASSERT_TRUE(WriteMesh(directory_ / "b.stl", document).ok());
  EXPECT_EQ(ReadBytes(directory_ / "b.stl"), text);
}

TEST_F(MeshFiles, StlSaysWhatIsWrong) {
  const std::string whole = BinaryStl({{0, 0, 0, 1, 0, 0, 0, 1, 0}});
  EXPECT_EQ(ErrorOf("a.stl", whole.substr(0, 100)),
            "truncated: a file of 1 triangle has 134 bytes, this one 100");
  EXPECT_EQ(ErrorOf("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
            "line 4: a vertex without three coordinates");
  EXPECT_EQ(ErrorOf("a.stl", "solid a\nouter loop\nvertex 0 0 0\n"),
            "line 3: truncated: the last triangle is not complete");
  EXPECT_EQ(ErrorOf("a.stl", "solid a\nendsolid a\n"), "no vertices, expected at least one");
  const PlyDocument more = Read("a.stl", whole + "tail");
  EXPECT_THAT(more.warnings, ElementsAre("4 bytes behind the last triangle left out"));
}

TEST_F(MeshFiles, LossesNameWhatAFormatCannotHold) {
  PlyDocument document = OddMesh(PlyType::kFloat64);
  AddColors(&document);
  AddColumn("vertex", "label", PlyType::kInt32, {1, 2, 3, 4, 5, 6, 7}, &document);
  AddColumn("face", "part", PlyType::kInt32, {1, 2, 3}, &document);
  EXPECT_THAT(LossesOf("a.ply", document), IsEmpty());
  EXPECT_THAT(LossesOf("a.obj", document),
              ElementsAre("a.obj: the format OBJ cannot hold the vertex properties label",
                          "a.obj: the format OBJ cannot hold the face properties part"));
  EXPECT_THAT(
      LossesOf("a.stl", document),
      ElementsAre("a.stl: the format STL holds floats: the coordinates, which are doubles, are "
                  "rounded",
                  "a.stl: the format STL holds triangles: 2 faces of more corners are cut",
                  "a.stl: the format STL holds triangles alone: 1 vertex that no face uses is left "
                  "out",
                  "a.stl: the format STL has no list of vertices: their order is lost, and those "
                  "at one place become one",
                  "a.stl: the format STL cannot hold the vertex properties red green blue label",
                  "a.stl: the format STL cannot hold the face properties part"));
  document.Find("face")->count = 0;
  document.Find("face")->properties.clear();
  EXPECT_THAT(WriteMesh(directory_ / "a.stl", document).message(),
              HasSubstr("an STL file holds triangles alone, and there are no faces"));
}

TEST_F(MeshFiles, AFileIsReadAsWhatItIsAndAWrongNameIsSaid) {
  const PlyDocument document = OddMesh(PlyType::kFloat32);
  for (const std::string content : {".ply", ".obj", ".off", ".stl"}) {
    ASSERT_TRUE(WriteMesh(directory_ / ("a" + content), document).ok());
    const std::string bytes = ReadBytes(directory_ / ("a" + content));
    for (const std::string ending : {".ply", ".obj", ".off", ".stl", ".vtk", ".glb", ".pcd"}) {
      if (ending == content) continue;
      const PlyDocument read = Read("b" + ending, bytes);
      ASSERT_THAT(read.warnings, ElementsAre(HasSubstr("the file is named as "))) << ending;
      EXPECT_THAT(read.warnings[0], HasSubstr(" and holds "));
    }
    EXPECT_THAT(Read("c.mesh", bytes).warnings, IsEmpty());
    EXPECT_THAT(Read("c", bytes).warnings, IsEmpty());
  }
}

TEST_F(MeshFiles, TheSpaceThatSlicerNamesSurvives) {
  PlyDocument document = OddMesh(PlyType::kFloat32);
  document.comments = {"3D Slicer output. SPACE=RAS"};
  for (const PlyFormat format : {PlyFormat::kAscii, PlyFormat::kBinaryLittleEndian}) {
    document.format = format;
    for (const std::string name : {"a.ply", "a.stl", "a.obj", "a.off"}) {
      const PlyDocument again = WrittenAndRead(document, name);
      EXPECT_EQ(SpaceOfDocument(again), AnatomicalSpace::kRas) << name;
      EXPECT_EQ(SpaceMarkOf(again), "SPACE=RAS") << name;
    }
  }
}

TEST_F(MeshFiles, AnUnknownEndingIsNotWritten) {
  EXPECT_EQ(WriteMesh(directory_ / "a.mesh", OddMesh(PlyType::kFloat32)).message(),
            directory_ / "a.mesh" +
                ": no format of meshes has the ending .mesh, expected one of .ply .pcd .vtp .vtk "
                ".glb .off .stl .obj");
  EXPECT_TRUE(CheckMeshEnding("/dev/stdout").ok());
  EXPECT_TRUE(CheckMeshEnding("folder.x/fitted").ok());
}

TEST_F(MeshFiles, DamagedBytesGiveAnErrorThatNamesTheFileOrADocument) {
  PlyDocument document = OddMesh(PlyType::kFloat64);
  AddColors(&document);
  for (const std::string name : {"a.obj", "a.off", "a.stl"}) {
    ASSERT_TRUE(WriteMesh(directory_ / name, document).ok());
    const std::string bytes = ReadBytes(directory_ / name);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      for (const char damage : {'\0', '-', '9', '\n', '\xff'}) {
        std::string damaged = bytes;
        damaged[i] = damage;
        WriteBytes(directory_ / name, damaged);
        const StatusOr<LoadedCloud> loaded = LoadCloud(directory_ / name);
        if (!loaded.ok()) EXPECT_THAT(loaded.status().message(), HasSubstr(name));
      }
      WriteBytes(directory_ / name, bytes.substr(0, i));
      const StatusOr<LoadedCloud> loaded = LoadCloud(directory_ / name);
      if (!loaded.ok()) EXPECT_THAT(loaded.status().message(), HasSubstr(name));
    }
  }
}

}  // namespace
}  // namespace ceres_ed
