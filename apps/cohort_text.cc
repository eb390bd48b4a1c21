#include "apps/cohort_text.h"

#include <cstdio>

namespace ceres_ed {
namespace {

std::string ShortText(double number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", number);
  return text;
}

std::string ShareText(double share) { return ShortText(100.0 * share) + " %"; }

}  // namespace

std::string ShardSummary(int run, int skipped, int failed) {
  return "members    " + std::to_string(run) + " run, " + std::to_string(skipped) +
         " skipped as done, " + std::to_string(failed) + " failed\n";
}

std::string CohortSummary(const CollectedMembers& all, const ShapeStatistics& statistics) {
  std::string text = "verdicts   " + std::to_string(all.Count(Grade::kGood)) + " good, " +
                     std::to_string(all.Count(Grade::kDoubtful)) + " doubtful, " +
                     std::to_string(all.Count(Grade::kBad)) + " bad, " +
                     std::to_string(all.Count(MemberState::kFailed)) + " failed, " +
                     std::to_string(all.Count(MemberState::kMissing)) + " missing\n";
  const nlohmann::ordered_json& report = statistics.report;
  if (!report.is_object()) return text;
  text += "mean       of " + std::to_string(report["shapes"].get<int>()) + " shapes, " +
          ShareText(statistics.change) + " of the diagonal away from the template\n";
  const std::vector<double> explained =
      report["components"]["explained"].get<std::vector<double>>();
  double sum = 0.0;
  std::string shares;
  for (std::size_t k = 0; k < explained.size(); ++k) {
    sum += explained[k];
    if (k < 3) shares += (k > 0 ? ", " : "") + ShareText(explained[k]);
  }
  if (!explained.empty()) {
    text += "components " + std::to_string(explained.size()) + " explain " + ShareText(sum) +
            " of the variance; the first ones " + shares + "\n";
  }
  if (report.contains("groups")) {
    text += "groups     least corrected p " +
            ShortText(report["groups"]["least_p_corrected"].get<double>()) + "\n";
  }
  for (const auto& round : report["rounds"]) {
    text += "round      " + std::to_string(round["round"].get<int>()) + ": the mean is " +
            ShareText(round["change"].get<double>()) + " of the diagonal away from its template\n";
  }
  return text;
}

}  // namespace ceres_ed
