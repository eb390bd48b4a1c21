// What a result depends on, as a short text: results with the same key need not be made again.
#ifndef CERES_ED_PIPELINE_COHORT_CONTENT_KEY_H_
#define CERES_ED_PIPELINE_COHORT_CONTENT_KEY_H_

#include <cstdint>
#include <string>
#include <string_view>

namespace ceres_ed {

// Collects what a result depends on: the FNV-1a hash (64 bits) of all parts in their order. It
// tells inputs apart that differ by accident, and is no protection against those that somebody has
// made to look alike.
class ContentKey {
 public:
  void AddText(std::string_view text);
  // Adds the contents of a file or, of a folder, the names, sizes and contents of all files in it.
  // A file that cannot be read counts as one that is not there.
  void AddFile(const std::string& path);

  // Returns 16 hexadecimal digits.
  std::string Text() const;

 private:
  void AddBytes(std::string_view bytes);
  void AddOneFile(const std::string& path);

  std::uint64_t hash_ = 14695981039346656037ULL;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_CONTENT_KEY_H_
