#include "ceres_ed/io/field/nifti_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/field/gzip_writer.h>
#include <ceres_ed/io/field/nifti_header.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr std::int16_t kFloat32 = 16;
constexpr std::int16_t kIntentVector = 1007;
constexpr std::uint8_t kMillimetres = 2;
constexpr std::int16_t kScannerCoordinates = 1;
// The header, and four bytes that say that nothing extends it.
constexpr std::size_t kDataOffset = sizeof(NiftiHeader) + 4;

// Writes the position of the grid in right-anterior-superior coordinates.
void SetGrid(const FieldGrid& grid, NiftiHeader* header) {
  const Eigen::Vector3d ras_from_lps(-1.0, -1.0, 1.0);
  const Eigen::Matrix3d axes = ras_from_lps.asDiagonal() * grid.direction;
  const Eigen::Vector3d origin = ras_from_lps.cwiseProduct(grid.origin);
  // The quaternion is that of a rotation; a reflection is kept as the sign of the third axis.
  const float sign = axes.determinant() < 0.0 ? -1.0f : 1.0f;
  Eigen::Matrix3d rotation = axes;
  rotation.col(2) *= sign;
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  header->pixdim[0] = sign;
  for (int r = 0; r < 3; ++r) {
    header->pixdim[1 + r] = static_cast<float>(grid.spacing[r]);
    header->quatern[r] = static_cast<float>(q.vec()[r]);
    header->qoffset[r] = static_cast<float>(origin[r]);
    for (int c = 0; c < 3; ++c) {
      header->srow[r][c] = static_cast<float>(axes(r, c) * grid.spacing[c]);
    }
    header->srow[r][3] = static_cast<float>(origin[r]);
  }
  header->qform_code = kScannerCoordinates;
  header->sform_code = kScannerCoordinates;
}

NiftiHeader MakeHeader(const DisplacementField& field) {
  NiftiHeader header;
  header.dim[0] = 5;
  for (int axis = 0; axis < 3; ++axis) {
    header.dim[1 + axis] = static_cast<std::int16_t>(field.grid.size[axis]);
  }
  header.dim[4] = 1;
  header.dim[5] = 3;
  header.dim[6] = header.dim[7] = 1;
  header.intent_code = kIntentVector;
  header.datatype = kFloat32;
  header.bitpix = 32;
  std::fill(header.pixdim + 4, header.pixdim + 8, 1.0f);
  header.vox_offset = static_cast<float>(kDataOffset);
  header.scl_slope = 1.0f;
  header.xyzt_units = kMillimetres;
  const std::size_t length = std::min(field.description.size(), sizeof(header.descrip) - 1);
  std::copy_n(field.description.begin(), length, header.descrip);
  const std::string name = "displacement";
  std::copy(name.begin(), name.end(), header.intent_name);
  SetGrid(field.grid, &header);
  return header;
}

Status CheckSize(const std::string& path, const FieldGrid& grid) {
  constexpr int kLargest = std::numeric_limits<std::int16_t>::max();
  for (const int size : grid.size) {
    if (size <= kLargest) continue;
    return Status::Error(path + ": " + std::to_string(size) +
                         " points along an axis, expected at most " + std::to_string(kLargest) +
                         " in a NIfTI file");
  }
  return Status::Ok();
}

// Calls write(bytes, size) with all of the file, piece by piece.
template <typename Write>
void WriteAll(const DisplacementField& field, const Write& write) {
  const NiftiHeader header = MakeHeader(field);
  write(&header, sizeof(header));
  const char no_extension[4] = {};
  write(no_extension, sizeof(no_extension));
  // One component after the other, each for all points.
  constexpr std::size_t kPiece = 1 << 14;
  std::vector<float> piece;
  for (std::size_t component = 0; component < 3; ++component) {
    for (std::size_t next = component; next < field.vectors.size();) {
      piece.clear();
      for (; piece.size() < kPiece && next < field.vectors.size(); next += 3) {
        piece.push_back(field.vectors[next]);
      }
      write(piece.data(), piece.size() * sizeof(float));
    }
  }
}

}  // namespace

Status WriteNiftiField(const std::string& path, const DisplacementField& field) {
  if (Status status = CheckSize(path, field.grid); !status.ok()) return status;
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  std::ostream& stream = (*file)->stream();
  WriteAll(field, [&stream](const void* bytes, std::size_t size) {
    stream.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  });
  return (*file)->Commit();
}

Status WriteNiftiGzField(const std::string& path, const DisplacementField& field) {
  if (!HasGzip()) {
    return Status::Error(path +
                         ": this build of ceres_ed cannot compress: name a .nii file, or install "
                         "zlib1g-dev and build again");
  }
  if (Status status = CheckSize(path, field.grid); !status.ok()) return status;
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  GzipWriter gzip(&(*file)->stream());
  WriteAll(field, [&gzip](const void* bytes, std::size_t size) { gzip.Write(bytes, size); });
  gzip.Finish();
  return (*file)->Commit();
}

}  // namespace ceres_ed
