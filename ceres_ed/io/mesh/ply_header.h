// Reads and writes the header of a PLY file.
#ifndef CERES_ED_IO_MESH_PLY_HEADER_H_
#define CERES_ED_IO_MESH_PLY_HEADER_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace ceres_ed {

struct PlyHeader {
  // Elements and properties with counts and types. Their values are still empty.
  PlyDocument document;
  // The number of bytes up to the end of the line `end_header`, this line included.
  std::size_t size = 0;
  // The number of lines up to `end_header`, this line included.
  int num_lines = 0;
  // The characters at which a line of the file ends. It ends at an LF, which may follow a CR. If
  // the first line of the file ends in CR alone, lines end at either of them.
  std::string_view line_ends = kLineFeed;

  static constexpr std::string_view kLineFeed = "\n";
  static constexpr std::string_view kCarriageReturnOrLineFeed = "\r\n";
};

// Returns the header at the start of `text` (the first bytes of the file `path`). The error names
// the line and what was expected. Everything is checked except the counts, which only the body can
// confirm. Lines end in LF, CR LF or CR alone, as the first one does. There may be a UTF-8 byte
// order mark at the start, and blanks at the end of a line.
StatusOr<PlyHeader> ParsePlyHeader(const std::string& path, std::string_view text);

// Returns the header of `document` as text, with LF line ends, up to `end_header`, this line
// included.
std::string FormatPlyHeader(const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_HEADER_H_
