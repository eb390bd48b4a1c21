#include "ceres_ed/io/mesh/face_groups.h"

#include <ceres_ed/util/text.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace ceres_ed {
namespace {

constexpr char kProperty[] = "group";

// A line `group NUMBER KEYWORD NAME`.
struct GroupLine {
  std::size_t number = 0;
  std::size_t keyword = 0;
  std::string name;
};

bool Parse(std::string_view line, std::size_t num_lines, GroupLine* parsed) {
  const std::vector<std::string_view> words = SplitWords(line, " ");
  if (words.size() < 4 || words[0] != kProperty) return false;
  const char* const end = words[1].data() + words[1].size();
  const auto result = std::from_chars(words[1].data(), end, parsed->number);
  // There is a line for each named group, so that no number is larger.
  if (result.ec != std::errc() || result.ptr != end || parsed->number > num_lines) return false;
  const auto* const keyword =
      std::find(FaceGroup::kKeywords.begin(), FaceGroup::kKeywords.end(), words[2]);
  if (keyword == FaceGroup::kKeywords.end()) return false;
  parsed->keyword = static_cast<std::size_t>(keyword - FaceGroup::kKeywords.begin());
  parsed->name = std::string(line.substr(static_cast<std::size_t>(words[3].data() - line.data())));
  return true;
}

}  // namespace

FaceGroups FaceGroups::Of(const PlyDocument& document) {
  FaceGroups groups;
  const PlyElement* const faces = document.Find("face");
  const PlyProperty* const column = faces == nullptr ? nullptr : faces->Find(kProperty);
  if (column == nullptr || column->is_list) return groups;
  for (const std::string& line : document.obj_info) {
    GroupLine parsed;
    if (!Parse(line, document.obj_info.size(), &parsed)) continue;
    if (parsed.number >= groups.groups_.size()) groups.groups_.resize(parsed.number + 1);
    groups.groups_[parsed.number].names[parsed.keyword] = parsed.name;
  }
  groups.of_faces_ = column->values;
  return groups;
}

void FaceGroups::Add(const FaceGroup& group) {
  if (of_faces_.empty() || !(groups_[static_cast<std::size_t>(of_faces_.back())] == group)) {
    const auto [entry, is_new] = number_of_.insert({group.names, groups_.size()});
    if (is_new) groups_.push_back(group);
    current_ = entry->second;
  }
  of_faces_.push_back(static_cast<double>(current_));
}

void FaceGroups::AppendTo(PlyDocument* document) const {
  PlyElement* const faces = document->Find("face");
  if (groups_.size() == 1 || faces == nullptr) return;
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    for (std::size_t i = 0; i < FaceGroup::kKeywords.size(); ++i) {
      const std::string& name = groups_[group].names[i];
      if (name.empty()) continue;
      document->obj_info.push_back(std::string(kProperty) + ' ' + std::to_string(group) + ' ' +
                                   FaceGroup::kKeywords[i] + ' ' + name);
    }
  }
  faces->properties.push_back(MakePlyScalar(kProperty, PlyType::kInt32, of_faces_));
}

const FaceGroup& FaceGroups::GroupOf(std::size_t face) const {
  static const FaceGroup kNone;
  if (face >= of_faces_.size()) return kNone;
  const double group = of_faces_[face];
  const bool exists = group >= 0.0 && group < static_cast<double>(groups_.size());
  return exists ? groups_[static_cast<std::size_t>(group)] : kNone;
}

}  // namespace ceres_ed
