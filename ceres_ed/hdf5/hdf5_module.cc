// ITK's transform files by libhdf5, for programs that load this module when such a file is written.
#include <ceres_ed/io/field/itk_hdf5_file.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <string>
#include <vector>

#include <hdf5.h>

namespace ceres_ed {
namespace {

// An object of libhdf5, which is closed at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (ok()) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool ok() const { return id_ >= 0; }
  hid_t id() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// Returns properties for creating groups or data sets, without times: the same field gives the same
// bytes.
hid_t PropertiesWithoutTimes(hid_t kind) {
  const hid_t properties = H5Pcreate(kind);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

bool WriteText(hid_t file, const char* name, const char* text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  const hsize_t one = 1;
  const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
  const Handle properties(PropertiesWithoutTimes(H5P_DATASET_CREATE), H5Pclose);
  if (H5Tset_size(type.id(), H5T_VARIABLE) < 0) return false;
  const Handle data(
      H5Dcreate2(file, name, type.id(), space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
      H5Dclose);
  return data.ok() && H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &text) >= 0;
}

bool WriteNumbers(hid_t file, const char* name, const std::vector<double>& numbers) {
  constexpr hsize_t kLongestChunk = 1 << 20;
  constexpr unsigned kCompression = 1;
  const hsize_t size = numbers.size();
  const hsize_t chunk = std::min(size, kLongestChunk);
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle properties(PropertiesWithoutTimes(H5P_DATASET_CREATE), H5Pclose);
  if (H5Pset_chunk(properties.id(), 1, &chunk) < 0) return false;
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) H5Pset_deflate(properties.id(), kCompression);
  const Handle data(
      H5Dcreate2(
          file, name, H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
      H5Dclose);
  return data.ok() &&
         H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0;
}

bool MakeGroup(hid_t file, const char* name) {
  const Handle properties(PropertiesWithoutTimes(H5P_GROUP_CREATE), H5Pclose);
  const Handle group(H5Gcreate2(file, name, H5P_DEFAULT, properties.id(), H5P_DEFAULT), H5Gclose);
  return group.ok();
}

// Returns the fixed parameters of ITK's DisplacementFieldTransform: size, origin, spacing, and the
// direction row by row.
std::vector<double> FixedParameters(const FieldGrid& grid) {
  std::vector<double> fixed(grid.size.begin(), grid.size.end());
  for (const Eigen::Vector3d& vector : {grid.origin, grid.spacing}) {
    fixed.insert(fixed.end(), vector.data(), vector.data() + 3);
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) fixed.push_back(grid.direction(row, column));
  }
  return fixed;
}

bool WriteField(hid_t file, const DisplacementField& field) {
  return WriteText(file, "/Comment", field.description.c_str()) &&
         MakeGroup(file, "/TransformGroup") && MakeGroup(file, "/TransformGroup/0") &&
         WriteText(
             file, "/TransformGroup/0/TransformType", "DisplacementFieldTransform_double_3_3") &&
         WriteNumbers(
             file, "/TransformGroup/0/TransformFixedParameters", FixedParameters(field.grid)) &&
         WriteNumbers(file,
                      "/TransformGroup/0/TransformParameters",
                      {field.vectors.begin(), field.vectors.end()});
}

StatusOr<std::string> MakeItkField(const std::string& path, const DisplacementField& field) {
  const Status failed = Status::Error(path + ": libhdf5 cannot make the file");
  // Errors are reported by the results; libhdf5 would print them.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  // The file stays in memory.
  constexpr std::size_t kGrowth = 1 << 24;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_fapl_core(access.id(), kGrowth, false) < 0) return failed;
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file.ok() || !WriteField(file.id(), field) || H5Fflush(file.id(), H5F_SCOPE_LOCAL) < 0) {
    return failed;
  }
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  if (size <= 0) return failed;
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file.id(), bytes.data(), bytes.size()) != size) return failed;
  return bytes;
}

}  // namespace
}  // namespace ceres_ed

extern "C" [[gnu::visibility("default")]] const ceres_ed::Hdf5Module* ceres_ed_hdf5_module() {
  static const ceres_ed::Hdf5Module module = {CERES_ED_VERSION_STRING, ceres_ed::MakeItkField};
  return &module;
}
