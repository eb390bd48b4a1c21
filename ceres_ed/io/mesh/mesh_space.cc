#include "ceres_ed/io/mesh/mesh_space.h"

#include <cstddef>
#include <string>

namespace ceres_ed {

std::string_view FindSpaceMark(std::string_view text) {
  for (const std::string_view mark : {"SPACE=LPS", "SPACE=RAS"}) {
    const std::size_t at = text.find(mark);
    if (at != std::string_view::npos) return text.substr(at, mark.size());
  }
  return {};
}

std::string_view SpaceMarkOf(const PlyDocument& document) {
  for (const std::string& comment : document.comments) {
    if (const std::string_view mark = FindSpaceMark(comment); !mark.empty()) return mark;
  }
  return {};
}

AnatomicalSpace SpaceOfDocument(const PlyDocument& document) {
  const std::string_view mark = SpaceMarkOf(document);
  if (mark.empty()) return AnatomicalSpace::kUnknown;
  return mark == "SPACE=RAS" ? AnatomicalSpace::kRas : AnatomicalSpace::kLps;
}

}  // namespace ceres_ed
