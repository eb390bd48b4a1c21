// The header of a PLY file, read and written.
#ifndef CERES_ED_IO_MESH_PLY_HEADER_H_
#define CERES_ED_IO_MESH_PLY_HEADER_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace ceres_ed {

struct PlyHeader {
  // Elements and properties with counts and types, their values still empty.
  PlyDocument document;
  // Bytes up to and with the end of the line `end_header`.
  std::size_t size = 0;
  // Lines up to and with `end_header`.
  int num_lines = 0;
  // Where a line of the file ends: at an LF, which a CR may precede, or in a file whose first line
  // ends in CR alone at either of them.
  std::string_view line_ends = kLineFeed;

  static constexpr std::string_view kLineFeed = "\n";
  static constexpr std::string_view kCarriageReturnOrLineFeed = "\r\n";
};

// Returns the header at the start of `text` (the first bytes of the file `path`), or an error that
// names the line and what was expected. Checks all but the counts, which only the body can tell.
// Lines end in LF, CR LF or CR alone, as the first one does; a byte order mark of UTF-8 may stand
// in front, and blanks may stand behind a line.
StatusOr<PlyHeader> ParsePlyHeader(const std::string& path, std::string_view text);

// Returns the header of `document` as text, with LF line ends, up to and with `end_header`.
std::string FormatPlyHeader(const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_HEADER_H_
