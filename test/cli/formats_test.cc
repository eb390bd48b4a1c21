// The programs on files of every format.
#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/mesh_view.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/cli/ed_fit_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The endings that this build reads and writes, beside .ply.
std::vector<std::string> Endings() {
  std::vector<std::string> endings = {".stl", ".obj", ".off"};
#ifdef CERES_ED_HAVE_VTK_MODULE
  endings.insert(endings.end(), {".vtk", ".vtp"});
#endif
#ifdef CERES_ED_HAVE_GLTF_MODULE
  endings.emplace_back(".glb");
#endif
  return endings;
}

class Formats : public EdFitTest {
 protected:
  // Rings of floats whose vertices are in the order in which the faces use them, the only order
  // that an STL has.
  Formats() {
    for (const std::string name : {"source", "target"}) {
      const PlyDocument ring = *ReadMesh(dir_ / (name + ".ply"));
      const std::vector<double>& corners = ring.Find("face")->properties[0].values;
      std::vector<double> new_row(ring.Find("vertex")->count, -1.0);
      std::vector<std::size_t> old_row;
      PlyDocument ordered = ring;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto old = static_cast<std::size_t>(corners[i]);
        if (new_row[old] < 0.0) {
          new_row[old] = static_cast<double>(old_row.size());
          old_row.push_back(old);
        }
        ordered.Find("face")->properties[0].values[i] = new_row[old];
      }
      for (const char* const axis : {"x", "y", "z"}) {
        PlyProperty& column = *ordered.Find("vertex")->Find(axis);
        column.type = PlyType::kFloat32;
        for (std::size_t i = 0; i < old_row.size(); ++i) {
          column.values[i] =
              static_cast<float>(ring.Find("vertex")->Find(axis)->values[old_row[i]]);
        }
      }
      ordered.format = PlyFormat::kBinaryLittleEndian;
      ExpectWritten(name + ".ply", ordered);
      for (const std::string& ending : Endings()) ExpectWritten(name + ending, ordered);
    }
  }

  void ExpectWritten(const std::string& name, const PlyDocument& document) {
    const Status status = WriteMesh(dir_ / name, document);
    EXPECT_TRUE(status.ok()) << status.message();
  }

  ProgramResult Fit(const std::string& source,
                    const std::string& target,
                    const std::string& output,
                    const std::vector<std::string>& flags = {}) {
    std::vector<std::string> arguments = {
        dir_ / source, dir_ / target, "-o", dir_ / output, "--node_spacing=0.2"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return RunProgramFile(AppPath("ed_fit"), arguments);
  }
};

TEST_F(Formats, FitsOfOneMeshInEveryFormatAgree) {
  ASSERT_EQ(Fit("source.ply", "target.ply", "fitted.ply").exit_code, 0);
  const std::vector<Eigen::Vector3d> expected = Load("fitted.ply").cloud.points;
  for (const std::string& ending : Endings()) {
    const std::string output = "fitted" + ending;
    const ProgramResult result = Fit("source" + ending, "target" + ending, output);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, BackendComplaints());
    const LoadedCloud fitted = Load(output);
    const bool is_double = fitted.document.Find("vertex")->Find("x")->type == PlyType::kFloat64;
    // Files of floats hold the fit up to their rounding, and those of doubles the fit itself.
    EXPECT_LT(LargestDistance(fitted.cloud.points, expected), is_double ? 2e-7 : 1e-9) << ending;
    EXPECT_EQ(fitted.cloud.triangles, Load("fitted.ply").cloud.triangles) << ending;
    // The warps agree in all digits.
    ASSERT_EQ(Fit("source" + ending, "target" + ending, output, {"--warp=" + (dir_ / "w.json")})
                  .exit_code,
              0);
    ASSERT_EQ(
        Fit("source.ply", "target.ply", "fitted.ply", {"--warp=" + (dir_ / "ply.json")}).exit_code,
        0);
    EXPECT_EQ(ReadBytes(dir_ / "w.json"), ReadBytes(dir_ / "ply.json")) << ending;
  }
}

TEST_F(Formats, FormatsMix) {
  const std::vector<std::string> endings = Endings();
  const ProgramResult result =
      Fit("source.stl", "target" + endings.back(), "out" + endings[endings.size() / 2]);
  ASSERT_EQ(result.exit_code, 0) << result.err;
}

#ifdef CERES_ED_HAVE_VTK_MODULE
TEST_F(Formats, AFitFromStlToVtkIsAVtp) {
  const ProgramResult result = Fit("source.stl", "target.vtk", "c.vtp");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, BackendComplaints());
  EXPECT_THAT(ReadBytes(dir_ / "c.vtp"), HasSubstr("<VTKFile type=\"PolyData\""));
}
#endif

TEST_F(Formats, OnlyAFileThatNeedsAModuleLoadsIt) {
  // Returns what the dynamic loader says of the files that a fit loads.
  const auto loaded = [this](const std::string& source, const std::string& output) {
    setenv("LD_DEBUG", "files", 1);
    setenv("LD_DEBUG_OUTPUT", (dir_ / "loaded").c_str(), 1);
    const ProgramResult result = Fit(source, "target.ply", output);
    unsetenv("LD_DEBUG");
    unsetenv("LD_DEBUG_OUTPUT");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(dir_ / "")) {
      if (entry.path().filename().string().rfind("loaded.", 0) != 0) continue;
      text += ReadBytes(entry.path());
      std::filesystem::remove(entry.path());
    }
    return text;
  };
  for (const std::string name : {"source.ply", "source.stl", "source.obj", "source.off"}) {
    const std::string files = loaded(name, "out.ply");
    EXPECT_THAT(files, HasSubstr("libgflags")) << "the loader says nothing";
    EXPECT_THAT(files, Not(HasSubstr("libceres_ed_"))) << name;
    EXPECT_THAT(files, Not(HasSubstr("libvtk"))) << name;
  }
#ifdef CERES_ED_HAVE_VTK_MODULE
  EXPECT_THAT(loaded("source.ply", "out.vtp"), HasSubstr("libceres_ed_vtk"));
#endif
}

TEST_F(Formats, ApplyEvalAndCheckTakeThem) {
  ASSERT_EQ(
      Fit("source.ply", "target.ply", "fitted.ply", {"--warp=" + (dir_ / "w.json")}).exit_code, 0);
  for (const std::string& ending : Endings()) {
    const ProgramResult applied = RunProgramFile(
        AppPath("ed_apply"),
        {dir_ / "w.json", dir_ / ("source" + ending), "-o", dir_ / ("moved" + ending)});
    ASSERT_EQ(applied.exit_code, 0) << applied.err;
    const ProgramResult measured = RunProgramFile(AppPath("ed_eval"),
                                                  {dir_ / ("moved" + ending),
                                                   dir_ / ("target" + ending),
                                                   "--truth=" + (dir_ / "fitted.ply"),
                                                   "--error_ply=" + (dir_ / ("error" + ending))});
    ASSERT_EQ(measured.exit_code, 0) << measured.err;
    const ProgramResult checked = RunProgramFile(
        AppPath("ed_check"), {dir_ / ("source" + ending), dir_ / ("target" + ending)});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
  }
}

TEST_F(Formats, WhatAnOutputCannotHoldIsAWarning) {
  RingOptions options;
  options.extras = true;
  WriteBytes(dir_ / "rich.ply", RingPly(options));
  const ProgramResult result = Fit("rich.ply", "target.ply", "out.stl");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("out.stl: the format STL cannot hold the vertex properties "));
  EXPECT_THAT(result.err, HasSubstr("label"));
}

TEST_F(Formats, AnOutputThatCannotHoldTheSourceIsAnErrorBeforeTheFit) {
  RingOptions options;
  options.faces = false;
  WriteBytes(dir_ / "points.ply", RingPly(options));
  const ProgramResult points = Fit("points.ply", "target.ply", "out.stl");
  EXPECT_EQ(points.exit_code, 2);
  EXPECT_THAT(points.err, HasSubstr("out.stl: the format STL holds triangles alone"));
  const ProgramResult mesh = Fit("source.ply", "target.ply", "out.pcd");
  EXPECT_EQ(mesh.exit_code, 2);
  EXPECT_THAT(mesh.err, HasSubstr("out.pcd: the format PCD holds points alone"));
  const ProgramResult graph = Fit("source.ply", "target.ply", "out.ply", {"--graph=g.stl"});
  EXPECT_EQ(graph.exit_code, 1);
  EXPECT_FALSE(Exists("out.pcd"));
}

TEST_F(Formats, AFileUnderAWrongNameIsReadAsWhatItIsAndSaid) {
  WriteBytes(dir_ / "renamed.stl", ReadBytes(dir_ / "source.ply"));
  const ProgramResult result = Fit("renamed.stl", "target.ply", "out.ply");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string sentence =
      "renamed.stl: the file is named as STL and holds PLY, as which it was read";
  EXPECT_THAT(result.err, HasSubstr(sentence));
  const ProgramResult measured =
      RunProgramFile(AppPath("ed_eval"), {dir_ / "renamed.stl", dir_ / "target.ply"});
  EXPECT_THAT(measured.err, HasSubstr(sentence));
}

TEST_F(Formats, AnUnknownEndingIsAUsageErrorBeforeAnyFileIsRead) {
  for (const std::string flag : {"--output=out.xyz", "--graph=g.xyz", "--covariance=c.xyz"}) {
    const ProgramResult result =
        RunProgramFile(AppPath("ed_fit"), {"none.ply", "none.ply", "--output=out.ply", flag});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("no format of meshes has the ending .xyz, expected one of"));
  }
  EXPECT_EQ(RunProgramFile(AppPath("ed_apply"), {"w.json", "none.ply", "--output=a.xyz"}).exit_code,
            1);
  EXPECT_EQ(RunProgramFile(AppPath("ed_eval"), {"a.ply", "b.ply", "--error_ply=a.xyz"}).exit_code,
            1);
}

TEST_F(Formats, AModuleThatIsMissingIsOneSentenceWithItsPackage) {
  for (const auto& [ending, module, package] :
       {std::tuple(".vtk", CERES_ED_VTK_MODULE, "ceres-ed-vtk, or libvtk9-dev"),
        std::tuple(".glb", CERES_ED_GLTF_MODULE, "ceres-ed-gltf, or libtinygltf-dev")}) {
    // A file that is no module, for one that is found elsewhere would be loaded.
    WriteBytes(dir_ / module, "no library");
    WriteBytes(dir_ / (std::string("a") + ending),
               std::string(ending) == ".vtk" ? "# vtk DataFile Version 3.0\n" : "glTF");
    ASSERT_EQ(setenv("CERES_ED_MODULES", dir_.path().c_str(), 1), 0);
    const ProgramResult result = Fit(std::string("a") + ending, "target.ply", "out.ply");
    unsetenv("CERES_ED_MODULES");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(std::string("install the package ") + package));
    EXPECT_EQ(SplitLines(result.err).size(), 1U) << result.err;
  }
}

}  // namespace
}  // namespace ceres_ed
