// VTK reads the meshes with displacements that ed_apply writes.
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/simulation/shapes.h>

#include <string>

#include <gtest/gtest.h>
#include <test/cli/run_program.h>
#include <test/io/io_test_util.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSmartPointer.h>
#include <vtkWarpVector.h>
#include <vtkXMLPolyDataReader.h>

namespace ceres_ed {
namespace {

// Six nodes that bend the surface: they rise with the square of x.
Warp Bend() {
  Warp warp;
  warp.state.Resize(6);
  for (int j = 0; j < 6; ++j) {
    const double x = 0.2 * j - 0.5;
    warp.graph.AddNode({x, 0.05 * j * (5 - j), 0.0});
    MutableNodeTranslation(warp.state.node(j)) = Eigen::Vector3d(0.1, 0.0, 0.6 * x * x);
  }
  warp.binding.distance = DistanceRule::kEuclidean;
  return warp;
}

vtkSmartPointer<vtkPolyData> ReadByVtk(const std::string& path) {
  if (path.find(".vtp") != std::string::npos) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->ReadAllVectorsOn();
  reader->Update();
  return reader->GetOutput();
}

TEST(DisplacementFile, IsAVectorOfEachPointByWhichVtkMovesTheMeshAsTheWarpDoes) {
  const TemporaryDirectory directory;
  const PointCloud rest = MakeSyntheticShape(SyntheticShape::kHeart, 600, 1.0);
  CloudWriteOptions options;
  options.double_precision = true;
  ASSERT_TRUE(WriteCloud(directory / "rest.ply", rest, options).ok());
  const Warp warp = Bend();
  ASSERT_TRUE(WriteWarp(directory / "warp.json", warp).ok());
  PointCloud moved = rest;
  ASSERT_TRUE(ApplyWarp(warp, &moved).ok());
  for (const std::string name : {"moves.vtp", "moves.vtk"}) {
    const std::string path = directory / name;
    const ProgramResult result =
        RunProgramFile(AppPath("ed_apply"),
                       {directory / "warp.json", directory / "rest.ply", "--displacement=" + path});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const vtkSmartPointer<vtkPolyData> mesh = ReadByVtk(path);
    ASSERT_EQ(mesh->GetNumberOfPoints(), static_cast<vtkIdType>(rest.size())) << name;
    EXPECT_EQ(mesh->GetNumberOfPolys(), static_cast<vtkIdType>(rest.triangles.size())) << name;
    vtkDataArray* const vectors = mesh->GetPointData()->GetArray("displacement");
    ASSERT_NE(vectors, nullptr) << name;
    ASSERT_EQ(vectors->GetNumberOfComponents(), 3) << name;
    // The filter that "Warp By Vector" of ParaView is.
    mesh->GetPointData()->SetActiveVectors("displacement");
    vtkNew<vtkWarpVector> filter;
    filter->SetInputData(mesh);
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    filter->Update();
    for (std::size_t p = 0; p < rest.size(); ++p) {
      const auto id = static_cast<vtkIdType>(p);
      EXPECT_LT((Eigen::Vector3d(mesh->GetPoint(id)) - rest.points[p]).norm(), 1e-7) << name;
      const Eigen::Vector3d at(filter->GetPolyDataOutput()->GetPoint(id));
      EXPECT_LT((at - moved.points[p]).norm(), 1e-6) << name << ", point " << p;
    }
  }
}

}  // namespace
}  // namespace ceres_ed
