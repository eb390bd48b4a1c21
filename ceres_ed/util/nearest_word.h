// What somebody may have meant who misspelt a word.
#ifndef CERES_ED_UTIL_NEAREST_WORD_H_
#define CERES_ED_UTIL_NEAREST_WORD_H_

#include <string>
#include <vector>

namespace ceres_ed {

// Returns how many letters must be put in, left out, changed, or swapped with the next one to turn
// one word into the other (optimal string alignment).
int EditDistance(const std::string& a, const std::string& b);

// Returns the word that is nearest to `misspelt`; nothing where none is near enough to be meant:
// about a letter in three may differ. Of words that are equally near, the first one.
std::string NearestWord(const std::string& misspelt, const std::vector<std::string>& words);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_NEAREST_WORD_H_
