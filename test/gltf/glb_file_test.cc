#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/mesh_format.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
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

void AppendNumber(std::uint32_t number, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&number), 4);
}

// A GLB of a header, a chunk of JSON and one of bytes.
std::string Glb(const nlohmann::json& json, std::string bytes) {
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  while (bytes.size() % 4 != 0) bytes += '\0';
  std::string file = "glTF";
  AppendNumber(2, &file);
  AppendNumber(static_cast<std::uint32_t>(28 + text.size() + bytes.size()), &file);
  AppendNumber(static_cast<std::uint32_t>(text.size()), &file);
  file += "JSON" + text;
  AppendNumber(static_cast<std::uint32_t>(bytes.size()), &file);
  return file + std::string("BIN\0", 4) + bytes;
}

// A triangle without indices, at a node that a parent moves and mirrors.
nlohmann::json TriangleScene() {
  return {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes",
       {{{"translation", {10, 0, 0}}, {"children", {1}}}, {{"scale", {-1, 2, 1}}, {"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {1, 1, 0}}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
      {"buffers", {{{"byteLength", 36}}}}};
}

std::string TriangleBytes() {
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(corners.data()), 36};
}

TEST(GlbFile, KeepsFloatsVerticesTrianglesColoursAndScalarsInTheirOrder) {
  const TemporaryDirectory directory;
  PlyDocument document = OddMesh(PlyType::kFloat32);
  AddNormals(PlyType::kFloat32, &document);
  AddColors(&document);
  AddColumn("vertex", "kind", PlyType::kUint8, {1, 2, 3, 4, 5, 6, 255}, &document);
  AddColumn("vertex", "label", PlyType::kInt32, {-7, 2, 3, 4, 5, 6, 9}, &document);
  ASSERT_TRUE(WriteMesh(directory / "a.glb", document).ok());
  EXPECT_THAT(
      LossesOf("a.glb", document),
      ElementsAre("a.glb: the format GLB holds triangles: 2 faces of more corners are cut"));
  const PlyDocument again = ReadOk(directory / "a.glb");
  EXPECT_THAT(again.warnings, IsEmpty());
  ExpectSameColumns(document,
                    again,
                    "vertex",
                    {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "label", "kind"},
                    true);
  EXPECT_EQ(again.Find("face")->count, 5U);
  ASSERT_TRUE(WriteMesh(directory / "b.glb", again).ok());
  EXPECT_EQ(ReadBytes(directory / "a.glb"), ReadBytes(directory / "b.glb"));
}

TEST(GlbFile, PlacesMeshesByTheirNodesAndKeepsTheirOutside) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "a.glb", Glb(TriangleScene(), TriangleBytes()));
  const PlyDocument document = ReadOk(directory / "a.glb");
  EXPECT_THAT(document.Find("vertex")->Find("x")->values, ElementsAre(10, 9, 10));
  EXPECT_THAT(document.Find("vertex")->Find("y")->values, ElementsAre(0, 0, 2));
  EXPECT_THAT(document.Find("face")->Find("vertex_indices")->values, ElementsAre(0, 2, 1));
}

TEST(GlbFile, SaysWhatIsWrong) {
  const TemporaryDirectory directory;
  const auto error_of = [&](const nlohmann::json& scene) {
    WriteBytes(directory / "a.glb", Glb(scene, TriangleBytes()));
    const std::string message = LoadCloud(directory / "a.glb").status().message();
    EXPECT_THAT(message, HasSubstr("a.glb: "));
    return message;
  };
  nlohmann::json scene = TriangleScene();
  scene["accessors"][0]["count"] = 4;
  EXPECT_THAT(error_of(scene), HasSubstr("an accessor leads outside of the data of the file"));
  scene = TriangleScene();
  scene["nodes"][1]["children"] = {0};
  EXPECT_THAT(error_of(scene), HasSubstr("its nodes are no tree"));
  scene = TriangleScene();
  scene["meshes"][0]["primitives"][0]["extensions"] = {{"KHR_draco_mesh_compression", {{"x", 1}}}};
  EXPECT_THAT(error_of(scene), HasSubstr("compressed by Draco"));
  scene = TriangleScene();
  scene["accessors"][0]["byteOffset"] = 4294967292U;
  EXPECT_THAT(error_of(scene), HasSubstr("an accessor leads outside of the data of the file"));
}

TEST(GlbFile, CutAndDamagedFilesGiveAnErrorThatNamesThemOrADocument) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(WriteMesh(directory / "a.glb", OddMesh(PlyType::kFloat32)).ok());
  const std::string bytes = ReadBytes(directory / "a.glb");
  for (std::size_t i = 4; i < bytes.size(); i += 3) {
    for (const char damage : {'\0', '-', '9', '\xff'}) {
      std::string damaged = bytes;
      damaged[i] = damage;
      WriteBytes(directory / "a.glb", damage == '\0' ? bytes.substr(0, i) : damaged);
      const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "a.glb");
      if (!loaded.ok()) EXPECT_THAT(loaded.status().message(), HasSubstr("a.glb"));
    }
  }
}

TEST(GlbFile, RefusesExtrasThatLieAbsurdlyDeep) {
  constexpr int kDepth = 200000;
  const TemporaryDirectory directory;
  std::string text = "{\"asset\":{\"version\":\"2.0\",\"extras\":";
  text += std::string(kDepth, '[') + std::string(kDepth, ']') + "}}";
  while (text.size() % 4 != 0) text += ' ';
  std::string file = "glTF";
  AppendNumber(2, &file);
  AppendNumber(static_cast<std::uint32_t>(20 + text.size()), &file);
  AppendNumber(static_cast<std::uint32_t>(text.size()), &file);
  WriteBytes(directory / "deep.glb", file + "JSON" + text);
  EXPECT_THAT(ReadMesh(directory / "deep.glb").status().message(), HasSubstr("64 deep"));
}

}  // namespace
}  // namespace ceres_ed
