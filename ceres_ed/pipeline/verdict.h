// Whether a result can be trusted, in one word with its reasons.
#ifndef CERES_ED_PIPELINE_VERDICT_H_
#define CERES_ED_PIPELINE_VERDICT_H_

#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

enum class Grade { kGood, kDoubtful, kBad };

constexpr std::array<NamedValue<Grade>, 3> NamesOf(Grade) {
  return {{{"good", Grade::kGood}, {"doubtful", Grade::kDoubtful}, {"bad", Grade::kBad}}};
}

// One figure that is not as it should be.
struct VerdictReason {
  // A word for programs, in snake_case.
  std::string code;
  // A sentence for people, with the value and its unit.
  std::string text;
  double value = 0.0;
  // The value from which on the result would be better than this.
  double bound = 0.0;
};

// The bounds of a figure between good and doubtful, and between doubtful and bad. Larger values are
// worse if the second bound is larger.
struct VerdictBounds {
  double doubtful = 0.0;
  double bad = 0.0;
};

// The grade of a result is that of its worst figure.
struct Verdict {
  Grade grade = Grade::kGood;
  std::vector<VerdictReason> reasons;
  // What a user can try, in sentences.
  std::vector<std::string> advice;

  // Adds a reason, and makes the grade at least as bad as `worst`. An empty or repeated advice is
  // not added.
  void Add(Grade worst, VerdictReason reason, const std::string& what_to_try);

  // Adds a reason if `value` is beyond the bounds.
  void Check(double value,
             const VerdictBounds& bounds,
             const std::string& code,
             const std::string& text,
             const std::string& what_to_try);

  // Returns the verdict in one line: the grade, and the first reason.
  std::string Sentence() const;
};

nlohmann::ordered_json VerdictReport(const Verdict& verdict);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_VERDICT_H_
