// VTK reads the fields that we write.
#include <ceres_ed/graph/space_warp.h>
#include <ceres_ed/pipeline/apply/field_run.h>

#include <string>

#include <gtest/gtest.h>
#include <test/graph/warp_examples.h>
#include <test/io/io_test_util.h>
#include <vtkDataArray.h>
#include <vtkGridTransform.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

namespace ceres_ed {
namespace {

TEST(VtiField, HasGridAndValuesInVtk) {
  const TemporaryDirectory directory;
  const Warp warp = MakeLatticeWarp(4, 0.1, 0.1);
  const auto space = *SpaceWarp::Create(warp);
  FieldSettings settings;
  settings.field = directory / "field.vti";
  settings.bounds = "0,2,0.5,2,1,1.5";
  settings.spacing = 0.25;
  // The coordinates stay those of the surfaces.
  settings.frame = SurfaceAxes::kRas;
  settings.unit = SurfaceUnit::kMetres;
  FieldObserver silent;
  ASSERT_TRUE(RunField(settings, "w.json", warp, nullptr, &silent).done());

  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(settings.field.c_str());
  reader->Update();
  vtkImageData* const image = reader->GetOutput();
  int size[3];
  image->GetDimensions(size);
  EXPECT_EQ(size[0], 9);
  EXPECT_EQ(size[1], 7);
  EXPECT_EQ(size[2], 3);
  for (int axis = 0; axis < 3; ++axis) EXPECT_DOUBLE_EQ(image->GetSpacing()[axis], 0.25);
  vtkDataArray* const vectors = image->GetPointData()->GetVectors("displacement");
  ASSERT_NE(vectors, nullptr);
  ASSERT_EQ(vectors->GetNumberOfComponents(), 3);
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p) {
    const Eigen::Vector3d x(image->GetPoint(p));
    const Eigen::Vector3d displacement(vectors->GetTuple3(p));
    EXPECT_LT((x + displacement - (*space)(x)).norm(), 1e-6) << p;
  }

  // VTK's own transform by such a field.
  image->GetPointData()->SetActiveScalars("displacement");
  vtkNew<vtkGridTransform> transform;
  transform->SetDisplacementGridData(image);
  const Eigen::Vector3d x(1.25, 1.0, 1.25);
  double moved[3];
  transform->TransformPoint(x.data(), moved);
  EXPECT_LT((Eigen::Vector3d(moved) - (*space)(x)).norm(), 1e-6);
}

}  // namespace
}  // namespace ceres_ed
