#include "ceres_ed/io/mesh/format_content.h"

#include <ceres_ed/io/mesh/stl_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <array>
#include <vector>

namespace ceres_ed {
namespace {

bool BeginsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

std::string_view WithoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return BeginsWith(text, kMark) ? text.substr(kMark.size()) : text;
}

// Returns the words of the first line that is neither blank nor a # comment.
std::vector<std::string_view> FirstWords(std::string_view start) {
  for (const std::string_view line : SplitLines(WithoutByteOrderMark(start), '\n')) {
    std::vector<std::string_view> words = SplitWords(line.substr(0, line.find('#')), " \t\r\v\f");
    if (!words.empty()) return words;
  }
  return {};
}

}  // namespace

bool IsPly(std::string_view start, std::size_t /*size*/) {
  const std::string_view text = WithoutByteOrderMark(start);
  return BeginsWith(text, "ply\n") || BeginsWith(text, "ply\r") || BeginsWith(text, "ply ");
}

bool IsPcd(std::string_view start, std::size_t /*size*/) {
  const std::vector<std::string_view> words = FirstWords(start);
  return BeginsWith(start, "# .PCD") || (words.size() == 2 && words[0] == "VERSION");
}

bool IsVtk(std::string_view start, std::size_t /*size*/) {
  return BeginsWith(start, "# vtk DataFile");
}

bool IsVtp(std::string_view start, std::size_t /*size*/) {
  const std::string_view text = Trim(WithoutByteOrderMark(start));
  return BeginsWith(text, "<") && text.find("<VTKFile") != std::string_view::npos;
}

bool IsGlb(std::string_view start, std::size_t /*size*/) { return BeginsWith(start, "glTF"); }

bool IsOff(std::string_view start, std::size_t /*size*/) {
  const std::vector<std::string_view> words = FirstWords(start);
  if (words.empty()) return false;
  constexpr std::size_t kLongest = 8;
  const std::size_t off = words[0].rfind("OFF");
  return off != std::string_view::npos && off + 3 == words[0].size() && words[0].size() <= kLongest;
}

bool IsStl(std::string_view start, std::size_t size) {
  if (HasSizeOfBinaryStl(start, size)) return true;
  const std::string_view text = Trim(start);
  return BeginsWith(text, "solid") && (text.find("facet") != std::string_view::npos ||
                                       text.find("endsolid") != std::string_view::npos);
}

bool IsObj(std::string_view start, std::size_t /*size*/) {
  constexpr std::array<std::string_view, 12> kKeywords = {
      "v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl"};
  const std::vector<std::string_view> words = FirstWords(start);
  const bool begins_as_obj =
      !words.empty() && std::find(kKeywords.begin(), kKeywords.end(), words[0]) != kKeywords.end();
  if (!begins_as_obj || start.find('\0') != std::string_view::npos) return false;
  for (const std::string_view line : SplitLines(start, '\n')) {
    const std::vector<std::string_view> vertex = SplitWords(line, " \t\r");
    if (vertex.size() >= 4 && vertex[0] == "v" && ParseDouble(vertex[1]).has_value()) return true;
  }
  return false;
}

}  // namespace ceres_ed
