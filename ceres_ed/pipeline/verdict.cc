#include "ceres_ed/pipeline/verdict.h"

#include <algorithm>
#include <utility>

namespace ceres_ed {

void Verdict::Add(Grade worst, VerdictReason reason, const std::string& what_to_try) {
  grade = std::max(grade, worst);
  reasons.push_back(std::move(reason));
  const bool known = std::find(advice.begin(), advice.end(), what_to_try) != advice.end();
  if (!known && !what_to_try.empty()) advice.push_back(what_to_try);
}

void Verdict::Check(double value,
                    const VerdictBounds& bounds,
                    const std::string& code,
                    const std::string& text,
                    const std::string& what_to_try) {
  const double sign = bounds.bad > bounds.doubtful ? 1.0 : -1.0;
  if (!(sign * value > sign * bounds.doubtful)) return;
  const Grade worst = sign * value > sign * bounds.bad ? Grade::kBad : Grade::kDoubtful;
  Add(worst, {code, text, value, bounds.doubtful}, what_to_try);
}

std::string Verdict::Sentence() const {
  std::string sentence = NameOf(grade);
  if (!reasons.empty()) sentence += ": " + reasons.front().text;
  if (!advice.empty()) sentence += "; " + advice.front();
  return sentence;
}

nlohmann::ordered_json VerdictReport(const Verdict& verdict) {
  nlohmann::ordered_json reasons = nlohmann::ordered_json::array();
  for (const VerdictReason& reason : verdict.reasons) {
    reasons.push_back({{"code", reason.code},
                       {"text", reason.text},
                       {"value", reason.value},
                       {"bound", reason.bound}});
  }
  return {{"grade", NameOf(verdict.grade)}, {"reasons", reasons}, {"advice", verdict.advice}};
}

}  // namespace ceres_ed
