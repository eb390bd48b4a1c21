// Finds the word that was probably meant by a misspelt one.
#ifndef CERES_ED_UTIL_NEAREST_WORD_H_
#define CERES_ED_UTIL_NEAREST_WORD_H_

#include <string>
#include <vector>

namespace ceres_ed {

// Returns the number of letters that must be inserted, deleted, changed, or swapped with the next
// one to turn one word into the other (optimal string alignment).
int EditDistance(const std::string& a, const std::string& b);

// Returns the word that is nearest to `misspelt`, or an empty string if none is near enough (about
// one letter in three may differ). If several are equally near, it is the first one.
std::string NearestWord(const std::string& misspelt, const std::vector<std::string>& words);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_NEAREST_WORD_H_
