#include "ceres_ed/io/field/field_format.h"

#include <ceres_ed/io/field/itk_hdf5_file.h>
#include <ceres_ed/io/field/meta_image_file.h>
#include <ceres_ed/io/field/nifti_file.h>
#include <ceres_ed/io/field/nrrd_file.h>
#include <ceres_ed/io/field/vti_file.h>

#include <algorithm>

namespace ceres_ed {
namespace {

constexpr FieldFormat kFormats[] = {
    {".nrrd", FieldSpace::kLps, 12, WriteNrrdField},
    {".nii.gz", FieldSpace::kLps, 12, WriteNiftiGzField},
    {".nii", FieldSpace::kLps, 12, WriteNiftiField},
    {".mha", FieldSpace::kLps, 12, WriteMhaField},
    {".mhd", FieldSpace::kLps, 12, WriteMhdField},
    {".h5", FieldSpace::kLps, 24, WriteItkHdf5Field},
    {".vti", FieldSpace::kAny, 12, WriteVtiField},
};

bool EndsWith(const std::string& text, const std::string& ending) {
  return text.size() > ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

StatusOr<const FieldFormat*> FieldFormatOf(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::string endings;
  for (const FieldFormat& format : kFormats) {
    if (EndsWith(name, format.ending)) return &format;
    endings += std::string(endings.empty() ? "" : ", ") + format.ending;
  }
  return Status::Error(path +
                       ": unknown format of a displacement field, expected a name that ends " +
                       "with one of " + endings);
}

}  // namespace ceres_ed
