#include "ceres_ed/io/field/meta_image_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/field/header_text.h>
#include <ceres_ed/io/mesh/byte_order.h>

#include <filesystem>
#include <string_view>

namespace ceres_ed {
namespace {

// Returns the header. `data` is the name of the file with the vectors; LOCAL means this one.
std::string Header(const DisplacementField& field, const std::string& data) {
  const FieldGrid& grid = field.grid;
  std::string text = "ObjectType = Image\nNDims = 3\nComment = " + field.description + "\n";
  text += "BinaryData = True\nBinaryDataByteOrderMSB = ";
  text += HostIsLittleEndian() ? "False" : "True";
  text += "\nCompressedData = False\nTransformMatrix =";
  // One axis after the other.
  for (int axis = 0; axis < 3; ++axis) text += " " + HeaderText(grid.direction.col(axis));
  text += "\nOffset = " + HeaderText(grid.origin) + "\nCenterOfRotation = 0 0 0\n";
  // The letters name where the axes come from.
  if (grid.direction.isIdentity(0.0)) text += "AnatomicalOrientation = RAI\n";
  text += "ElementSpacing = " + HeaderText(grid.spacing) + "\nDimSize =";
  for (const int size : grid.size) text += " " + std::to_string(size);
  return text +
         "\nElementNumberOfChannels = 3\nElementType = MET_FLOAT\nElementDataFile = " + data + "\n";
}

std::string_view Bytes(const DisplacementField& field) {
  return {reinterpret_cast<const char*>(field.vectors.data()),
          field.vectors.size() * sizeof(float)};
}

}  // namespace

Status WriteMhaField(const std::string& path, const DisplacementField& field) {
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  (*file)->stream() << Header(field, "LOCAL") << Bytes(field);
  return (*file)->Commit();
}

Status WriteMhdField(const std::string& path, const DisplacementField& field) {
  const std::filesystem::path data = std::filesystem::path(path).replace_extension(".raw");
  // The header comes last: when it is there, the data are.
  if (Status status = WriteFileAtomically(data.string(), Bytes(field)); !status.ok()) {
    return status;
  }
  return WriteFileAtomically(path, Header(field, data.filename().string()));
}

}  // namespace ceres_ed
