// An HTML page in one file.
#ifndef CERES_ED_REPORT_HTML_PAGE_H_
#define CERES_ED_REPORT_HTML_PAGE_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// A table of texts. Numbers stand at the right.
struct HtmlTable {
  // What the table shows, for those who cannot see where it stands.
  std::string caption;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  // The number of columns at the left that are words; all others are numbers.
  int word_columns = 1;
};

// Builds a page from its top to its end. Every text that goes in is escaped, unless a name says
// that it is HTML.
class HtmlPage {
 public:
  // Starts a page with its heading.
  explicit HtmlPage(const std::string& title);

  // Starts a section, which is listed at the top of the page.
  void Section(const std::string& title);
  void Subsection(const std::string& title);
  void Paragraph(const std::string& text);
  // A paragraph in a box that catches the eye. `kind` is a class of the style sheet: good,
  // doubtful, bad or note.
  void Notice(const std::string& kind, const std::string& head, const std::string& text);
  void List(const std::vector<std::string>& items);
  // A table that stands open, or behind a line that opens it.
  void Table(const HtmlTable& table);
  void FoldedTable(const std::string& line, const HtmlTable& table);
  // A text in its own lines, such as a command, that a button copies.
  void Code(const std::string& text);
  // A plot with words below it; nothing if `svg_html` is empty.
  void Plot(const std::string& svg_html, const std::string& words);
  // Lets the page show pictures that lie beside it. Otherwise it fetches nothing.
  void AllowFilesBeside() { has_files_beside_ = true; }
  // Parts that are HTML already.
  void Html(const std::string& html) { body_ += html; }
  // Data for the scripts of the page, under an id of letters.
  void Data(const std::string& id, const nlohmann::ordered_json& data);

  // Returns the whole page, with the style sheet and the scripts.
  std::string Finish() const;

 private:
  std::string title_;
  std::string contents_;
  std::string body_;
  std::string data_;
  int sections_ = 0;
  bool has_files_beside_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_PAGE_H_
