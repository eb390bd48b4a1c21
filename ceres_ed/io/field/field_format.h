// The formats of displacement fields, which are chosen by the ending of a file's name.
#ifndef CERES_ED_IO_FIELD_FIELD_FORMAT_H_
#define CERES_ED_IO_FIELD_FIELD_FORMAT_H_

#include <ceres_ed/io/field/displacement_field.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// The coordinates that the readers of a format expect.
enum class FieldSpace {
  // Patient coordinates in millimetres: x to the left, y to the back (posterior), z to the head
  // (superior). ITK, and all that is built on it, works in these.
  kLps,
  // Any coordinates. The reader shows the file beside surfaces in the same coordinates.
  kAny,
};

// A row of the table in field_format.cc. To add a format, write a file with its function and add a
// row.
struct FieldFormat {
  // The ending of a file's name, in lower case.
  const char* ending;
  FieldSpace space;
  // The size of a grid point in the file, in bytes, before compression.
  int bytes_per_point;
  // Writes `field`, whose grid is in the coordinates of `space`. After an error the old file is
  // unchanged.
  Status (*write)(const std::string& path, const DisplacementField& field);
};

// Returns the format for the ending of `path`, in lower or upper case. The error lists the endings.
StatusOr<const FieldFormat*> FieldFormatOf(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_FIELD_FORMAT_H_
