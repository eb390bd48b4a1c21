// The grid in the header of a NIfTI file.
#include <ceres_ed/io/field/file_start.h>
#include <ceres_ed/io/field/grid_reader.h>
#include <ceres_ed/io/field/nifti_header.h>

#include <cmath>
#include <cstring>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// The position of the first point and the steps along the axes, in right-anterior-superior
// coordinates and the unit of the file.
struct Placement {
  Eigen::Vector3d origin;
  Eigen::Matrix3d steps;
};

Placement PlacementOf(const NiftiHeader& header) {
  Placement placement;
  if (header.sform_code > 0) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) placement.steps(r, c) = header.srow[r][c];
      placement.origin[r] = header.srow[r][3];
    }
    return placement;
  }
  const Eigen::Vector3d vec(header.quatern[0], header.quatern[1], header.quatern[2]);
  const double w = std::sqrt(std::max(0.0, 1.0 - vec.squaredNorm()));
  const Eigen::Quaterniond q(w, vec.x(), vec.y(), vec.z());
  const double sign = header.pixdim[0] < 0.0f ? -1.0 : 1.0;
  placement.steps =
      q.normalized().toRotationMatrix() *
      Eigen::Vector3d(header.pixdim[1], header.pixdim[2], sign * header.pixdim[3]).asDiagonal();
  placement.origin = {header.qoffset[0], header.qoffset[1], header.qoffset[2]};
  return placement;
}

double MillimetresIn(std::uint8_t units) {
  constexpr int kMetres = 1;
  constexpr int kMicrometres = 3;
  // The other bits are the unit of time.
  switch (units & 7) {
    case kMetres:
      return 1000.0;
    case kMicrometres:
      return 0.001;
    default:
      return 1.0;
  }
}

}  // namespace

StatusOr<FieldGrid> ReadNiftiGrid(const std::string& path) {
  // Compressed headers are hardly longer.
  constexpr std::size_t kStart = 4096;
  const StatusOr<std::string> bytes = ReadStart(path, kStart);
  if (!bytes.ok()) return bytes.status();
  NiftiHeader header;
  const NiftiHeader expected;
  if (bytes->size() >= sizeof(header)) std::memcpy(&header, bytes->data(), sizeof(header));
  if (bytes->size() < sizeof(header) || header.sizeof_hdr != expected.sizeof_hdr ||
      std::memcmp(header.magic, expected.magic, sizeof(header.magic)) != 0) {
    return Status::Error(path + ": no header of NIfTI-1, expected 348 bytes in the order of this " +
                         "machine that end with n+1");
  }
  if (header.dim[0] < 3 || header.dim[0] > 7 ||
      (header.sform_code <= 0 && header.qform_code <= 0)) {
    return Status::Error(path + ": " + std::to_string(header.dim[0]) + " dimensions, sform_code " +
                         std::to_string(header.sform_code) + " and qform_code " +
                         std::to_string(header.qform_code) +
                         ", expected 3 dimensions or more and a code > 0");
  }
  const Placement placement = PlacementOf(header);
  const Eigen::Vector3d lps_from_ras =
      MillimetresIn(header.xyzt_units) * Eigen::Vector3d(-1.0, -1.0, 1.0);
  return GridFromSteps(path,
                       {static_cast<double>(header.dim[1]),
                        static_cast<double>(header.dim[2]),
                        static_cast<double>(header.dim[3])},
                       lps_from_ras.cwiseProduct(placement.origin),
                       lps_from_ras.asDiagonal() * placement.steps);
}

}  // namespace ceres_ed
