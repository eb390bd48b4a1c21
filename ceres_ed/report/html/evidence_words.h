// What a fit shows about its own quality, in words.
#ifndef CERES_ED_REPORT_HTML_EVIDENCE_WORDS_H_
#define CERES_ED_REPORT_HTML_EVIDENCE_WORDS_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns sentences on the "evidence" of a report.json: how much of both surfaces is matched, how
// far the matched parts are apart, how much lengths change and faces fold. Figures that the report
// does not have are left out.
std::vector<std::string> EvidenceSentences(const nlohmann::ordered_json& report);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_EVIDENCE_WORDS_H_
