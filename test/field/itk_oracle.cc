#include "itk_oracle.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <itkDisplacementFieldTransform.h>
#include <itkHDF5TransformIOFactory.h>
#include <itkImageFileReader.h>
#include <itkImageFileWriter.h>
#include <itkImageRegionIteratorWithIndex.h>
#include <itkMetaImageIOFactory.h>
#include <itkNiftiImageIOFactory.h>
#include <itkNrrdImageIOFactory.h>
#include <itkResampleImageFilter.h>
#include <itkTransformFactory.h>
#include <itkTransformFileReader.h>
#include <itkTxtTransformIOFactory.h>

namespace ceres_ed {
namespace {

using Transform = itk::Transform<double, 3, 3>;
using FieldTransform = itk::DisplacementFieldTransform<double, 3>;
using Field = FieldTransform::DisplacementFieldType;
using ScalarImage = itk::Image<float, 3>;

void RegisterFormats() {
  static const bool once = [] {
    itk::NrrdImageIOFactory::RegisterOneFactory();
    itk::NiftiImageIOFactory::RegisterOneFactory();
    itk::MetaImageIOFactory::RegisterOneFactory();
    itk::HDF5TransformIOFactory::RegisterOneFactory();
    itk::TxtTransformIOFactory::RegisterOneFactory();
    itk::TransformFactory<FieldTransform>::RegisterTransform();
    return true;
  }();
  static_cast<void>(once);
}

bool IsTransformFile(const std::string& path) {
  return path.find(".h5") != std::string::npos || path.find(".tfm") != std::string::npos;
}

Transform::Pointer ReadTransform(const std::string& path) {
  RegisterFormats();
  try {
    if (IsTransformFile(path)) {
      const auto reader = itk::TransformFileReaderTemplate<double>::New();
      reader->SetFileName(path);
      reader->Update();
      EXPECT_EQ(reader->GetTransformList()->size(), 1u);
      return dynamic_cast<Transform*>(reader->GetTransformList()->front().GetPointer());
    }
    const auto reader = itk::ImageFileReader<Field>::New();
    reader->SetFileName(path);
    reader->Update();
    const auto transform = FieldTransform::New();
    transform->SetDisplacementField(reader->GetOutput());
    return transform.GetPointer();
  } catch (const itk::ExceptionObject& error) {
    ADD_FAILURE() << error;
    return nullptr;
  }
}

ItkPoint FromItk(const itk::Point<double, 3>& point) { return {point[0], point[1], point[2]}; }

itk::Point<double, 3> ToItk(const ItkPoint& point) {
  itk::Point<double, 3> result;
  for (unsigned i = 0; i < 3; ++i) result[i] = point[i];
  return result;
}

ScalarImage::Pointer MakeImage(const ItkGrid& grid) {
  const auto image = ScalarImage::New();
  ScalarImage::SizeType size;
  ScalarImage::SpacingType spacing;
  ScalarImage::DirectionType direction;
  for (unsigned r = 0; r < 3; ++r) {
    size[r] = grid.size[r];
    spacing[r] = grid.spacing[r];
    for (unsigned c = 0; c < 3; ++c) direction[r][c] = grid.direction[3 * r + c];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->SetOrigin(ToItk(grid.origin));
  image->SetDirection(direction);
  image->Allocate(true);
  return image;
}

}  // namespace

bool HaveItk() { return true; }

std::vector<ItkPoint> MapByItk(const std::string& path, const std::vector<ItkPoint>& points) {
  const Transform::Pointer transform = ReadTransform(path);
  std::vector<ItkPoint> mapped;
  for (const ItkPoint& point : points) {
    mapped.push_back(transform == nullptr ? point
                                          : FromItk(transform->TransformPoint(ToItk(point))));
  }
  return mapped;
}

ItkGrid ReadGridByItk(const std::string& path) {
  RegisterFormats();
  ItkGrid grid;
  try {
    const auto reader = itk::ImageFileReader<ScalarImage>::New();
    reader->SetFileName(path);
    reader->Update();
    const ScalarImage& image = *reader->GetOutput();
    grid.origin = FromItk(image.GetOrigin());
    for (unsigned r = 0; r < 3; ++r) {
      grid.size[r] = static_cast<int>(image.GetLargestPossibleRegion().GetSize()[r]);
      grid.spacing[r] = image.GetSpacing()[r];
      for (unsigned c = 0; c < 3; ++c) grid.direction[3 * r + c] = image.GetDirection()[r][c];
    }
  } catch (const itk::ExceptionObject& error) {
    ADD_FAILURE() << error;
  }
  return grid;
}

void WriteImageByItk(const std::string& path, const ItkGrid& grid) {
  RegisterFormats();
  try {
    const auto writer = itk::ImageFileWriter<ScalarImage>::New();
    writer->SetFileName(path);
    writer->SetInput(MakeImage(grid));
    writer->SetUseCompression(true);
    writer->Update();
  } catch (const itk::ExceptionObject& error) {
    ADD_FAILURE() << error;
  }
}

ItkPoint ResampleBallByItk(const std::string& path,
                           const ItkGrid& grid,
                           const ItkPoint& center,
                           double radius) {
  const Transform::Pointer transform = ReadTransform(path);
  if (transform == nullptr) return center;
  using Iterator = itk::ImageRegionIteratorWithIndex<ScalarImage>;
  const ScalarImage::Pointer image = MakeImage(grid);
  itk::Point<double, 3> point;
  for (Iterator at(image, image->GetLargestPossibleRegion()); !at.IsAtEnd(); ++at) {
    image->TransformIndexToPhysicalPoint(at.GetIndex(), point);
    at.Set(point.EuclideanDistanceTo(ToItk(center)) < radius ? 1.0f : 0.0f);
  }
  const auto resample = itk::ResampleImageFilter<ScalarImage, ScalarImage>::New();
  resample->SetInput(image);
  resample->SetReferenceImage(image);
  resample->UseReferenceImageOn();
  resample->SetTransform(transform);
  resample->Update();
  ItkPoint sum = {0.0, 0.0, 0.0};
  double weights = 0.0;
  const ScalarImage::Pointer result = resample->GetOutput();
  for (Iterator at(result, result->GetLargestPossibleRegion()); !at.IsAtEnd(); ++at) {
    result->TransformIndexToPhysicalPoint(at.GetIndex(), point);
    for (unsigned i = 0; i < 3; ++i) sum[i] += at.Get() * point[i];
    weights += at.Get();
  }
  return {sum[0] / weights, sum[1] / weights, sum[2] / weights};
}

}  // namespace ceres_ed
