#include "ceres_ed/vtk/array_line.h"

#include <ceres_ed/util/text.h>

#include <charconv>
#include <string_view>
#include <system_error>

namespace ceres_ed {
namespace {

constexpr char kKeyword[] = "vtk_array";

}  // namespace

std::string ArrayLine::Format() const {
  return std::string(kKeyword) + ' ' + element + ' ' + std::to_string(components) + ' ' + role +
         ' ' + column + ' ' + name;
}

std::optional<ArrayLine> ArrayLine::Parse(const std::string& line) {
  const std::vector<std::string_view> words = SplitWords(line, " ");
  if (words.size() < 6 || words[0] != kKeyword) return std::nullopt;
  ArrayLine parsed;
  parsed.element = std::string(words[1]);
  const char* const end = words[2].data() + words[2].size();
  const auto result = std::from_chars(words[2].data(), end, parsed.components);
  if (result.ec != std::errc() || result.ptr != end || parsed.components == 0) return std::nullopt;
  parsed.role = std::string(words[3]);
  parsed.column = std::string(words[4]);
  parsed.name = line.substr(static_cast<std::size_t>(words[5].data() - line.data()));
  return parsed;
}

std::vector<std::string> ColumnNames(const std::string& base,
                                     std::size_t components,
                                     bool is_normals,
                                     bool is_colors) {
  if (is_normals) return {"nx", "ny", "nz"};
  if (is_colors && components == 3) return {"red", "green", "blue"};
  if (is_colors) return {"red", "green", "blue", "alpha"};
  if (components == 1) return {base};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < components; ++i) names.push_back(base + '_' + std::to_string(i));
  return names;
}

}  // namespace ceres_ed
