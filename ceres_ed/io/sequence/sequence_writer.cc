#include "ceres_ed/io/sequence/sequence_writer.h"

namespace ceres_ed {

const SequenceLayout* FindSequenceLayout(SequenceFormat format, bool is_stereo) {
  for (const SequenceLayout& layout : kSequenceLayouts) {
    if (layout.is_stereo != is_stereo) continue;
    if (format == SequenceFormat::kAuto || layout.format == format) return &layout;
  }
  return nullptr;
}

std::string ListSequenceLayouts(bool is_stereo, const char* separator) {
  std::string names;
  for (const SequenceLayout& layout : kSequenceLayouts) {
    if (layout.is_stereo != is_stereo) continue;
    names += (names.empty() ? "" : separator) + NameOf(layout.format);
  }
  return names;
}

}  // namespace ceres_ed
