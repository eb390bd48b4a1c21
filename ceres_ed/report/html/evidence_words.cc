#include "ceres_ed/report/html/evidence_words.h"

#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/view/number_text.h>

#include <cmath>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

constexpr double kPercent = 100.0;

// Returns "12.3 %".
std::string Percent(double share) { return ShortNumber(kPercent * share) + " %"; }

// Returns how one surface lies on the other one; empty if it is not known.
std::string CoverSentence(const ordered_json& evidence, const char* one, const char* other) {
  const double matched = NumberOf(evidence, {one, "matched"});
  const double missed = NumberOf(evidence, {one, "missed"});
  const double unseen = NumberOf(evidence, {one, "unseen"});
  if (!std::isfinite(matched + missed + unseen)) return "";
  std::string sentence = Percent(matched) + " of the " + one + " lies on the " + other;
  if (unseen > 0.0) sentence += "; of " + Percent(unseen) + " the " + other + " shows nothing";
  sentence += missed > 0.0
                  ? "; " + Percent(missed) + " is missed although the " + other + " shows it."
                  : "; nothing that the " + std::string(other) + " shows is missed.";
  return sentence;
}

}  // namespace

std::vector<std::string> EvidenceSentences(const ordered_json& report) {
  const ordered_json& evidence = MemberOf(report, {"evidence"});
  std::vector<std::string> sentences;
  for (const std::string& sentence :
       {CoverSentence(evidence, "source", "target"), CoverSentence(evidence, "target", "source")}) {
    if (!sentence.empty()) sentences.push_back(sentence);
  }
  const double residual = NumberOf(evidence, {"residual"});
  if (residual >= 0.0) {
    sentences.push_back("The matched parts are " + Percent(residual) +
                        " of the diagonal apart (root mean square); the noise of the target is " +
                        Percent(NumberOf(evidence, {"noise"})) + ".");
  }
  const double stretch = NumberOf(evidence, {"edge_stretch"});
  if (stretch >= 0.0) {
    sentences.push_back("95 % of the lengths on the source change by less than a factor of " +
                        ShortNumber(std::exp(stretch)) + ".");
  }
  const double folded = NumberOf(evidence, {"folded"});
  if (folded > 0.0) {
    sentences.push_back(Percent(folded) + " of the faces are folded over or squeezed flat.");
  }
  const double bend = NumberOf(evidence, {"bend"});
  if (bend >= 0.0) {
    sentences.push_back("Points are " + Percent(bend) +
                        " of the diagonal from the best rigid motion of the source, in the mean.");
  }
  return sentences;
}

}  // namespace ceres_ed
