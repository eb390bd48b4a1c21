#include "ceres_ed/report/html/page.h"

#include <ceres_ed/report/html/assets.h>
#include <ceres_ed/report/html/escape.h>
#include <ceres_ed/version.h>

#include <cstddef>

namespace ceres_ed {
namespace {

// Nothing may be fetched, whatever a text says, but pictures where the page allows them.
constexpr char kPolicy[] =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; base-uri 'none'; "
    "form-action 'none'; img-src data:";
constexpr char kFilesBeside[] = " 'self' file:";

std::string Cell(const std::string& text, bool is_number, bool is_head) {
  const std::string tag = is_head ? "th" : "td";
  const std::string scope = is_head ? " scope=\"col\"" : "";
  return "<" + tag + scope + (is_number ? " class=\"n\"" : "") + ">" + EscapeHtml(text) + "</" +
         tag + ">";
}

std::string TableHtml(const HtmlTable& table) {
  std::string html = "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"" +
                     EscapeHtml(table.caption) + "\"><table><caption>" + EscapeHtml(table.caption) +
                     "</caption><thead><tr>";
  const auto is_number = [&table](std::size_t column) {
    return static_cast<int>(column) >= table.word_columns;
  };
  for (std::size_t c = 0; c < table.head.size(); ++c) {
    html += Cell(table.head[c], is_number(c), true);
  }
  html += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) html += Cell(row[c], is_number(c), false);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

HtmlPage::HtmlPage(const std::string& title) : title_(title) {}

void HtmlPage::Section(const std::string& title) {
  const std::string id = "section" + std::to_string(++sections_);
  body_ += "<h2 id=\"" + id + "\">" + EscapeHtml(title) + "</h2>\n";
  contents_ += "<a href=\"#" + id + "\">" + EscapeHtml(title) + "</a>\n";
}

void HtmlPage::Subsection(const std::string& title) {
  body_ += "<h3>" + EscapeHtml(title) + "</h3>\n";
}

void HtmlPage::Paragraph(const std::string& text) { body_ += "<p>" + EscapeHtml(text) + "</p>\n"; }

void HtmlPage::Notice(const std::string& kind, const std::string& head, const std::string& text) {
  body_ += "<p class=\"notice " + EscapeHtml(kind) + "\"><strong>" + EscapeHtml(head) +
           "</strong> " + EscapeHtml(text) + "</p>\n";
}

void HtmlPage::List(const std::vector<std::string>& items) {
  if (items.empty()) return;
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += "<li>" + EscapeHtml(item) + "</li>\n";
  body_ += "</ul>\n";
}

void HtmlPage::Table(const HtmlTable& table) {
  if (!table.rows.empty()) body_ += TableHtml(table);
}

void HtmlPage::FoldedTable(const std::string& line, const HtmlTable& table) {
  if (table.rows.empty()) return;
  body_ +=
      "<details><summary>" + EscapeHtml(line) + "</summary>\n" + TableHtml(table) + "</details>\n";
}

void HtmlPage::Code(const std::string& text) {
  body_ += "<div class=\"code\"><pre tabindex=\"0\">" + EscapeHtml(text) +
           "</pre><button type=\"button\" class=\"copy\">Copy</button></div>\n";
}

void HtmlPage::Plot(const std::string& svg_html, const std::string& words) {
  if (svg_html.empty()) return;
  body_ +=
      "<figure>\n" + svg_html + "<figcaption>" + EscapeHtml(words) + "</figcaption></figure>\n";
}

void HtmlPage::Data(const std::string& id, const nlohmann::ordered_json& data) {
  data_ += "<script type=\"application/json\" id=\"" + EscapeHtml(id) + "\">" +
           JsonForScript(data) + "</script>\n";
}

std::string HtmlPage::Finish() const {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
      std::string(kPolicy) + (has_files_beside_ ? kFilesBeside : "") +
      "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"ceres_ed " +
      kVersion + "\">\n<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      EscapeHtml(title_) + "</title>\n<style>\n";
  html += ReportCss();
  html +=
      "</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#main\">To the "
      "report</a>\n<header><h1>" +
      EscapeHtml(title_) + "</h1>\n";
  if (!contents_.empty()) html += "<nav aria-label=\"Sections\">\n" + contents_ + "</nav>\n";
  html += "</header>\n<main id=\"main\">\n" + body_ + "</main>\n" + data_;
  // The page is complete before the scripts are read.
  for (const std::string_view script : {ThreeJs(), OrbitControlsJs(), ReportJs()}) {
    if (data_.empty() && script != ReportJs()) continue;
    // The scripts of the view share their names among each other, but not with others.
    const bool is_ours = script == ReportJs();
    html += is_ours ? "<script>\n(function () {\n'use strict';\n" : "<script>\n";
    html += script;
    html += is_ours ? "})();\n</script>\n" : "\n</script>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace ceres_ed
