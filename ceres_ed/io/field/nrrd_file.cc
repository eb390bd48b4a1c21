#include "ceres_ed/io/field/nrrd_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/field/gzip_writer.h>
#include <ceres_ed/io/field/header_text.h>
#include <ceres_ed/io/mesh/byte_order.h>

#include <memory>

namespace ceres_ed {
namespace {

std::string Parenthesised(const Eigen::Vector3d& vector) {
  return "(" + HeaderText(vector, ",") + ")";
}

std::string Header(const DisplacementField& field) {
  const FieldGrid& grid = field.grid;
  std::string text = "NRRD0005\n# " + field.description + "\n";
  text += "type: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 3";
  for (const int size : grid.size) text += " " + std::to_string(size);
  text += "\nspace directions: none";
  for (int axis = 0; axis < 3; ++axis) {
    text += " " + Parenthesised(grid.spacing[axis] * grid.direction.col(axis));
  }
  text += "\nkinds: vector domain domain domain\n";
  text += std::string("endian: ") + (HostIsLittleEndian() ? "little" : "big") + "\n";
  text += std::string("encoding: ") + (HasGzip() ? "gzip" : "raw") + "\n";
  text += "space units: \"mm\" \"mm\" \"mm\"\n";
  text += "space origin: " + Parenthesised(grid.origin) + "\n";
  text += "measurement frame: (1,0,0) (0,1,0) (0,0,1)\n";
  // An empty line ends the header.
  return text + "\n";
}

}  // namespace

Status WriteNrrdField(const std::string& path, const DisplacementField& field) {
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  std::ostream& stream = (*file)->stream();
  stream << Header(field);
  const std::size_t size = field.vectors.size() * sizeof(float);
  if (HasGzip()) {
    GzipWriter gzip(&stream);
    gzip.Write(field.vectors.data(), size);
    gzip.Finish();
  } else {
    stream.write(reinterpret_cast<const char*>(field.vectors.data()),
                 static_cast<std::streamsize>(size));
  }
  return (*file)->Commit();
}

}  // namespace ceres_ed
