// The page of a cohort: a table of all shapes with small pictures, and their statistics.
#ifndef CERES_ED_REPORT_HTML_COHORT_PAGE_H_
#define CERES_ED_REPORT_HTML_COHORT_PAGE_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// One shape, pair or sequence. Figures that are not known are NaN.
struct CohortPageRow {
  std::string name;
  std::string group;
  // good, doubtful, bad, failed or missing.
  std::string verdict;
  std::string message;
  // The larger one of both shares without a partner.
  double unmatched = 0.0;
  double landmark_rms = 0.0;
  double stretch = 0.0;
  double seconds = 0.0;
  // Whether it takes part in the statistics.
  bool in_model = false;
  // Paths seen from the page; empty if there is no such file.
  std::string report;
  std::string thumbnail;
};

struct CohortPageContent {
  // shapes, pairs or sequences.
  std::string kind;
  // The template as it was named; empty if there is none.
  std::string source;
  // In the order in which they are shown at first.
  std::vector<CohortPageRow> rows;
  // statistics.json; null if there is none.
  nlohmann::ordered_json statistics;
};

// Returns the page. Its table can be sorted by any column, and shows one group or verdict at
// choice. The pictures lie beside the page, so that it stays small.
std::string CohortPage(const CohortPageContent& content);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_COHORT_PAGE_H_
