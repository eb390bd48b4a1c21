#include "ceres_ed/io/field/vti_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/field/header_text.h>
#include <ceres_ed/io/mesh/byte_order.h>

#include <cstdint>
#include <memory>

namespace ceres_ed {
namespace {

std::string Header(const DisplacementField& field) {
  const FieldGrid& grid = field.grid;
  std::string extent;
  for (const int size : grid.size) {
    extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(size - 1);
  }
  const Eigen::Matrix3d rows = grid.direction.transpose();
  std::string text = "<?xml version=\"1.0\"?>\n<!-- " + field.description + " -->\n";
  text += "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"";
  text += HostIsLittleEndian() ? "LittleEndian" : "BigEndian";
  text += "\" header_type=\"UInt64\">\n<ImageData WholeExtent=\"" + extent + "\" Origin=\"" +
          HeaderText(grid.origin) + "\" Spacing=\"" + HeaderText(grid.spacing) + "\" Direction=\"" +
          HeaderText(rows.col(0)) + " " + HeaderText(rows.col(1)) + " " + HeaderText(rows.col(2)) +
          "\">\n";
  text += "<Piece Extent=\"" + extent + "\">\n<PointData Vectors=\"displacement\">\n";
  text += "<DataArray type=\"Float32\" Name=\"displacement\" NumberOfComponents=\"3\" ";
  text += "format=\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n</ImageData>\n";
  // The data begin behind the underscore with their size in bytes.
  return text + "<AppendedData encoding=\"raw\">\n_";
}

}  // namespace

Status WriteVtiField(const std::string& path, const DisplacementField& field) {
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  std::ostream& stream = (*file)->stream();
  stream << Header(field);
  const std::uint64_t size = field.vectors.size() * sizeof(float);
  stream.write(reinterpret_cast<const char*>(&size), sizeof(size));
  stream.write(reinterpret_cast<const char*>(field.vectors.data()),
               static_cast<std::streamsize>(size));
  stream << "\n</AppendedData>\n</VTKFile>\n";
  return (*file)->Commit();
}

}  // namespace ceres_ed
